// Averages the samples of a pixel over paper. This is the twin of reveal.rs.

struct FinishParams {
    paper: vec3<f32>,
    has_paper: u32,
    size: vec2<u32>,
    // Samples along each side of a pixel.
    samples: u32,
    // Whether the fourth value of the samples is their colour.
    only_grey: u32,
}

struct Fragment {
    triangle: u32,
    second: f32,
    third: f32,
    depth: f32,
}

@group(0) @binding(0) var<uniform> params: FinishParams;
@group(0) @binding(1) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> fragments: array<Fragment>;
@group(0) @binding(3) var<storage, read_write> picture: array<vec4<f32>>;

@compute @workgroup_size(8, 8)
fn volumes_finish(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.size) {
        return;
    }
    let stride = params.size.x * params.samples;
    var sum = vec3(0.0);
    var seen = 0.0;
    for (var y = 0u; y < params.samples; y++) {
        for (var x = 0u; x < params.samples; x++) {
            let at = (id.y * params.samples + y) * stride + id.x * params.samples + x;
            if fragments[at].triangle != 0xffffffffu {
                let color = colors[at];
                sum += select(color.xyz, vec3(color.w), params.only_grey == 1u);
                seen += 1.0;
            }
        }
    }
    let all = f32(params.samples * params.samples);
    var pixel = vec4(1.0, 1.0, 1.0, 0.0);
    if params.has_paper == 1u {
        pixel = vec4((sum + params.paper * (all - seen)) / all, 1.0);
    } else if seen > 0.0 {
        pixel = vec4(sum / seen, seen / all);
    }
    picture[id.y * params.size.x + id.x] = pixel;
}
