// Density by up to four textures, one after the other; twin of density.rs.

struct DensityParams {
    strength: vec4<f32>,
    pivot: vec4<f32>,
    size: vec2<u32>,
    layers: u32,
    masked: u32,
    overall: f32,
    spare: u32,
    more: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: DensityParams;
@group(0) @binding(1) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> first: array<f32>;
@group(0) @binding(3) var<storage, read> second: array<f32>;
@group(0) @binding(4) var<storage, read> third: array<f32>;
@group(0) @binding(5) var<storage, read> fourth: array<f32>;
@group(0) @binding(6) var<storage, read> mask: array<f32>;
@group(0) @binding(7) var<storage, read_write> changed: array<vec4<f32>>;

// A colour at density 1 + excess; an excess of 0 keeps its bits.
fn at_density(c: vec3<f32>, excess: f32) -> vec3<f32> {
    return clamp(c * (1.0 - excess + excess * c), vec3(0.0), vec3(1.0));
}

@compute @workgroup_size(8, 8)
fn watercolor_density(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.size) {
        return;
    }
    let i = id.y * params.size.x + id.x;
    var color = colors[i];
    if color.w > 0.0 {
        var texture = vec4(0.0);
        if params.layers > 0u { texture.x = first[i]; }
        if params.layers > 1u { texture.y = second[i]; }
        if params.layers > 2u { texture.z = third[i]; }
        if params.layers > 3u { texture.w = fourth[i]; }
        var share = 1.0;
        if params.masked != 0u { share = mask[i]; }
        // A strength of 0 leaves the colour.
        let excess = max(params.strength * (texture - params.pivot) * share, vec4(-1.0));
        var c = at_density(color.xyz, params.overall);
        c = at_density(c, excess.x);
        c = at_density(c, excess.y);
        c = at_density(c, excess.z);
        c = at_density(c, excess.w);
        color = vec4(c, color.w);
    }
    changed[i] = color;
}
