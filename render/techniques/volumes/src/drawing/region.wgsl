// Lays the colour of a region over what is there, by the tint of its count. This is the twin of
// reveal.rs.

struct RegionParams {
    size: vec2<u32>,
    // Highest count of the table.
    last: i32,
    // Whether the grey of the samples lies under this region.
    first_region: u32,
    stain: vec3<f32>,
    // Whether the inside is the samples' own colour.
    own_colors: u32,
    tints: array<vec4<f32>, 16>,
}

@group(0) @binding(0) var<uniform> params: RegionParams;
@group(0) @binding(1) var<storage, read> shaded: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> counts: array<i32>;
@group(0) @binding(3) var<storage, read> inside: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> composed: array<vec4<f32>>;

@compute @workgroup_size(8, 8)
fn volumes_region(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.size) {
        return;
    }
    let at = id.y * params.size.x + id.x;
    let own = shaded[at];
    var under = composed[at].xyz;
    if params.first_region == 1u {
        under = vec3(own.w);
    }
    if counts[at] > 0 {
        under *= params.stain;
    }
    let count = u32(clamp(counts[at], 0, params.last));
    let tint = params.tints[count / 4u][count % 4u];
    var color = own.xyz;
    if params.own_colors == 0u {
        color = inside[at].xyz;
    }
    if tint >= 1.0 {
        under = color;
    } else if tint > 0.0 {
        under = under * (1.0 - tint) + color * tint;
    }
    composed[at] = vec4(under, own.w);
}
