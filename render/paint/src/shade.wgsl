// From internal reflectance to light: surface, colour, relief, gloss; twin of shade.rs.

// What a lamp makes of slopes.
struct Bumps {
    // Of n . l / l_z by the slopes along x and y, for a normal of any length.
    towards_lamp: vec2<f32>,
    ambient: f32,
    // Slope in cells a cell for one quantum over two cells.
    slope: f32,
    // (l + v) / |l + v|; the fourth is 0.
    halfway: vec4<f32>,
    // Of wet, dry and bare: strength, exponent, h_z to the exponent, 0.
    gloss: array<vec4<f32>, 3>,
}

// Saunderson's shares.
struct Skin {
    k1: f32,
    k2: f32,
    floor: f32,
    // Whether relief counts at all.
    bumpy: u32,
}

fn measured(skin: Skin, internal: vec4<f32>) -> vec4<f32> {
    let through = (1.0 - skin.k1) * (1.0 - skin.k2);
    return skin.floor + through * internal / (1.0 - skin.k2 * internal);
}

// What binds `now` gives it `skin` and `rgb_from_nodes`.
fn color(internal: Nodes) -> vec3<f32> {
    let low = measured(now.skin, internal.low);
    let high = measured(now.skin, internal.high);
    let sum = low.x * now.rgb_from_nodes[0] + low.y * now.rgb_from_nodes[1]
        + low.z * now.rgb_from_nodes[2] + low.w * now.rgb_from_nodes[3]
        + high.x * now.rgb_from_nodes[4] + high.y * now.rgb_from_nodes[5]
        + high.z * now.rgb_from_nodes[6] + high.w * now.rgb_from_nodes[7];
    return sum.xyz;
}

// `heights` are those to the left, right, above and below.
fn shaded(bumps: Bumps, heights: vec4<i32>, bare: u32, flat_color: vec3<f32>) -> vec3<f32> {
    let h = vec4<f32>(heights);
    let slopes = bumps.slope * vec2(h.y - h.x, h.w - h.z);
    let length = sqrt(dot(slopes, slopes) + 1.0);
    let lit = max((1.0 + dot(slopes, bumps.towards_lamp)) / length, 0.0);
    let diffuse = 1.0 + (1.0 - bumps.ambient) * (lit - 1.0);
    let mirrored = (bumps.halfway.z - dot(slopes, bumps.halfway.xy)) / length;
    let gloss = bumps.gloss[min(bare, 2u)];
    var shine = 0.0;
    if gloss.x != 0.0 && mirrored > bumps.halfway.z {
        shine = gloss.x * max(pow(mirrored, gloss.y) - gloss.z, 0.0);
    }
    return flat_color * diffuse + shine;
}
