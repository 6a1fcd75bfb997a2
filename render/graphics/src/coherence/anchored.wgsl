// Blends the copies of a texture that follow particles. This is the twin of anchored.rs.

struct AnchoredParams {
    model_from_clip: mat4x4<f32>,
    width: u32,
    height: u32,
    texture_width: u32,
    texture_height: u32,
    first: u32,
    count: u32,
    octaves: u32,
    reach_squared: f32,
}

struct Anchor {
    position: vec3<f32>,
    presence: f32,
    x: f32,
    y: f32,
    texels: f32,
    spare: f32,
    weights: array<f32, 8>,
    right: array<f32, 8>,
    down: array<f32, 8>,
}

@group(0) @binding(0) var<uniform> params: AnchoredParams;
@group(0) @binding(1) var<storage, read> depths: array<f32>;
@group(0) @binding(2) var<storage, read> noise: array<f32>;
@group(0) @binding(3) var<storage, read> anchors: array<Anchor>;
@group(0) @binding(4) var<storage, read_write> blended: array<f32>;

fn texel(x: i32, y: i32) -> f32 {
    let column = u32(x) & (params.texture_width - 1u);
    let row = u32(y) & (params.texture_height - 1u);
    return noise[row * params.texture_width + column];
}

fn bilinear(at: vec2<f32>) -> f32 {
    let corner = floor(at);
    let part = at - corner;
    let x = i32(corner.x);
    let y = i32(corner.y);
    let above = mix(texel(x, y), texel(x + 1, y), part.x);
    let below = mix(texel(x, y + 1), texel(x + 1, y + 1), part.x);
    return mix(above, below, part.y);
}

fn distance_squared(position: vec3<f32>, anchor: u32) -> f32 {
    let apart = position - anchors[anchor].position;
    return dot(apart, apart);
}

@compute @workgroup_size(8, 8)
fn anchor_textures(@builtin(global_invocation_id) at: vec3<u32>) {
    if at.x >= params.width || at.y >= params.height {
        return;
    }
    let pixel = at.y * params.width + at.x;
    let depth = depths[pixel];
    if depth >= 1.0 {
        blended[pixel] = 0.5;
        return;
    }
    let center = vec2<f32>(at.xy) + 0.5;
    let size = vec2<f32>(f32(params.width), f32(params.height));
    let clip = vec2(2.0, -2.0) * center / size + vec2(-1.0, 1.0);
    let model = params.model_from_clip * vec4(clip, depth, 1.0);
    let position = model.xyz / model.w;
    let end = params.first + params.count;
    var nearest = distance_squared(position, params.first);
    for (var i = params.first + 1u; i < end; i++) {
        nearest = min(nearest, distance_squared(position, i));
    }
    var sum = 0.0;
    var squares = 0.0;
    for (var i = params.first; i < end; i++) {
        let near = 1.0 - (distance_squared(position, i) - nearest) / params.reach_squared;
        if near <= 0.0 {
            continue;
        }
        let weight = near * near * anchors[i].presence;
        let away = center - vec2(anchors[i].x, anchors[i].y);
        var texels = anchors[i].texels;
        var differs = 0.0;
        for (var octave = 0u; octave < params.octaves; octave++) {
            let start = vec2(anchors[i].right[octave], anchors[i].down[octave]);
            let value = bilinear(away * texels + start);
            differs += anchors[i].weights[octave] * (value - 0.5);
            texels *= 0.5;
        }
        sum += weight * differs;
        squares += weight * weight;
    }
    blended[pixel] = clamp(0.5 + sum / sqrt(squares), 0.0, 1.0);
}
