// From internal reflectance to light, through surface reflection, colour, relief and gloss. This is
// the twin of row.rs.

// A lamp, prepared for shading relief. This is the twin of `ReliefLamp` in relief_lamp.rs.
struct LampParams {
    // Derivative of n . l / l_z by the slopes along x and y, before normalisation of n.
    towards_lamp: vec2<f32>,
    // Share of ambient light, 0 to 1.
    ambient: f32,
    // Slope for a height difference of one quantum over two cells, times the lamp's relief.
    slope: f32,
    // h = (l + v) / |l + v|. The fourth component is 0.
    halfway: vec4<f32>,
    // For wet paint, dry paint and ground: strength, exponent, h_z to the exponent, 0.
    gloss: array<vec4<f32>, 3>,
    // Cells towards the lamp: offset along x and y, slope per quantum, slope of the ray to the
    // lamp.
    shadow: array<vec4<f32>, 6>,
    // Cells around: offset along x and y, slope per quantum, 0.
    around: array<vec4<f32>, 8>,
    // How far a slope overtops the lamp's where half of the light is left.
    soft: f32,
    // Most that relief may add to the light of level paint.
    most: f32,
    padding: vec2<f32>,
}

// Shares of light reflected at the surface. This is the twin of `SceneSurface` in optics.rs.
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

// The uniform `params` of the including shader has fields `surface`, `rgb_from_nodes` and `lamp`.
// We cannot pass uniforms to functions without copying them.
fn color(internal: Nodes) -> vec3<f32> {
    let low = measured(params.surface, internal.low);
    let high = measured(params.surface, internal.high);
    let sum = low.x * params.rgb_from_nodes[0] + low.y * params.rgb_from_nodes[1]
        + low.z * params.rgb_from_nodes[2] + low.w * params.rgb_from_nodes[3]
        + high.x * params.rgb_from_nodes[4] + high.y * params.rgb_from_nodes[5]
        + high.z * params.rgb_from_nodes[6] + high.w * params.rgb_from_nodes[7];
    return sum.xyz;
}

// Slope up to the cell of a tap, less what the tap subtracts.
fn rise(tap: vec4<f32>, at: vec2<i32>, here: f32) -> f32 {
    return tap.z * (top(at + vec2<i32>(tap.xy)) - here) - tap.w;
}

// Shades a cell. `column` holds the heights in quanta of the cell above, of this cell, and of the
// cell below. `material` is 0 wet paint, 1 dry paint, 2 ground. The including shader has a function
// `top`, the height at a cell or at the nearest cell of the canvas.
fn shade(at: vec2<i32>, column: vec3<f32>, material: u32, flat_color: vec3<f32>) -> vec3<f32> {
    let here = column.y;
    var hidden = 0.0;
    for (var i = 0u; i < 6u; i++) {
        hidden = max(hidden, rise(params.lamp.shadow[i], at, here));
    }
    var sky = 0.0;
    for (var i = 0u; i < 8u; i++) {
        let up = max(rise(params.lamp.around[i], at, here), 0.0);
        sky += up * up;
    }
    // Quotients take long on software devices, so there are few.
    let soft = params.lamp.soft * params.lamp.soft;
    let free = soft / (soft + hidden * hidden);
    let open = 1.0 / (1.0 + 0.125 * sky);

    let slopes = params.lamp.slope * vec2(
        top(at + vec2(1, 0)) - top(at - vec2(1, 0)),
        column.z - column.x,
    );
    let per_length = inverseSqrt(dot(slopes, slopes) + 1.0);
    let lit = max((1.0 + dot(slopes, params.lamp.towards_lamp)) * per_length, 0.0);
    let ambient = params.lamp.ambient;
    let diffuse = 1.0 + ambient * (open - 1.0) + (1.0 - ambient) * (free * lit - 1.0);

    let most = max(max(flat_color.x, flat_color.y), max(flat_color.z, 0.0));
    let more = max(diffuse - 1.0, 0.0);
    let room = max(1.0 - most, 1e-6);
    let bound = params.lamp.most * room;
    let factor =
        min(diffuse, 1.0) + more * bound / (bound + more * (params.lamp.most * most + room));
    let color = flat_color * factor;

    let n_dot_h = (params.lamp.halfway.z - dot(slopes, params.lamp.halfway.xy)) * per_length;
    let gloss = params.lamp.gloss[min(material, 2u)];
    let facing = gloss.x != 0.0 && n_dot_h > params.lamp.halfway.z;
    let above = max(pow(max(n_dot_h, 0.0), gloss.y) - gloss.z, 0.0);
    let mirrored = select(0.0, free * gloss.x * above, facing);
    return color + mirrored / (1.0 + mirrored) * (1.0 - color);
}
