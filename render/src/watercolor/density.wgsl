// Density by up to four textures, one upon the other; twin of density.rs.

struct DensityNow {
    strength: vec4<f32>,
    pivot: vec4<f32>,
    size: vec2<u32>,
    layers: u32,
    masked: u32,
    overall: f32,
    spare: u32,
    more: vec2<u32>,
}

@group(0) @binding(0) var<uniform> now: DensityNow;
@group(0) @binding(1) var<storage, read> colors: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> first: array<f32>;
@group(0) @binding(3) var<storage, read> second: array<f32>;
@group(0) @binding(4) var<storage, read> third: array<f32>;
@group(0) @binding(5) var<storage, read> fourth: array<f32>;
@group(0) @binding(6) var<storage, read> mask: array<f32>;
@group(0) @binding(7) var<storage, read_write> changed: array<vec4<f32>>;

// An excess of 0 keeps the bits.
fn denser(c: vec3<f32>, excess: f32) -> vec3<f32> {
    return clamp(c * (1.0 - excess + excess * c), vec3(0.0), vec3(1.0));
}

@compute @workgroup_size(8, 8)
fn watercolor_density(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= now.size) {
        return;
    }
    let i = id.y * now.size.x + id.x;
    var color = colors[i];
    if color.w > 0.0 {
        var texture = vec4(0.0);
        if now.layers > 0u { texture.x = first[i]; }
        if now.layers > 1u { texture.y = second[i]; }
        if now.layers > 2u { texture.z = third[i]; }
        if now.layers > 3u { texture.w = fourth[i]; }
        var share = 1.0;
        if now.masked != 0u { share = mask[i]; }
        // A strength of 0 leaves the colour.
        let excess = max(now.strength * (texture - now.pivot) * share, vec4(-1.0));
        var c = denser(color.xyz, now.overall);
        c = denser(c, excess.x);
        c = denser(c, excess.y);
        c = denser(c, excess.z);
        c = denser(c, excess.w);
        color = vec4(c, color.w);
    }
    changed[i] = color;
}
