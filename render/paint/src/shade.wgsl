// From internal reflectance to light, through surface reflection, colour, relief and
// gloss; twin of shade.rs.

// A lamp, prepared for shading slopes.
struct LampParams {
    // Derivative of n . l / l_z by the slopes along x and y, before normalisation of n.
    towards_lamp: vec2<f32>,
    // Share of ambient light, 0 to 1.
    ambient: f32,
    // Slope for a height difference of one quantum over two cells, times the lamp's relief.
    slope: f32,
    // h = (l + v) / |l + v|; the fourth component is 0.
    halfway: vec4<f32>,
    // For wet paint, dry paint and ground: strength, exponent, h_z to the exponent, 0.
    gloss: array<vec4<f32>, 3>,
}

// Shares of light reflected at the surface; twin of `SceneSurface` in optics.rs.
struct SurfaceParams {
    k1: f32,
    k2: f32,
    specular: f32,
    // 0 to skip relief and gloss.
    relief_on: u32,
}

fn measured(surface: SurfaceParams, internal: vec4<f32>) -> vec4<f32> {
    let through = (1.0 - surface.k1) * (1.0 - surface.k2);
    return surface.specular + through * internal / (1.0 - surface.k2 * internal);
}

// The uniform `params` of the including shader has fields `surface` and `rgb_from_nodes`.
fn color(internal: Nodes) -> vec3<f32> {
    let low = measured(params.surface, internal.low);
    let high = measured(params.surface, internal.high);
    let sum = low.x * params.rgb_from_nodes[0] + low.y * params.rgb_from_nodes[1]
        + low.z * params.rgb_from_nodes[2] + low.w * params.rgb_from_nodes[3]
        + high.x * params.rgb_from_nodes[4] + high.y * params.rgb_from_nodes[5]
        + high.z * params.rgb_from_nodes[6] + high.w * params.rgb_from_nodes[7];
    return sum.xyz;
}

// Shades a cell. `heights` are those of the cells to the left, right, above and below, in
// quanta; `material` is 0 wet paint, 1 dry paint, 2 ground.
fn shade(
    lamp: LampParams,
    heights: vec4<i32>,
    material: u32,
    flat_color: vec3<f32>,
) -> vec3<f32> {
    let h = vec4<f32>(heights);
    let slopes = lamp.slope * vec2(h.y - h.x, h.w - h.z);
    let length = sqrt(dot(slopes, slopes) + 1.0);
    let lit = max((1.0 + dot(slopes, lamp.towards_lamp)) / length, 0.0);
    let diffuse = 1.0 + (1.0 - lamp.ambient) * (lit - 1.0);
    let n_dot_h = (lamp.halfway.z - dot(slopes, lamp.halfway.xy)) / length;
    let gloss = lamp.gloss[min(material, 2u)];
    var highlight = 0.0;
    if gloss.x != 0.0 && n_dot_h > lamp.halfway.z {
        highlight = gloss.x * max(pow(n_dot_h, gloss.y) - gloss.z, 0.0);
    }
    return flat_color * diffuse + highlight;
}
