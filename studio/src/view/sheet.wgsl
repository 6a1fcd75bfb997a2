// Pictures and even areas, and nothing else: a driver in software runs every line of a
// shader for every pixel.

// Whether what is written is taken as linear light, and encoded on the way.
override decodes: bool = false;

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) place: vec2<f32>,
    @location(1) color: vec4<f32>,
}

@group(0) @binding(0) var cells: texture_2d<f32>;
@group(0) @binding(1) var between: sampler;

@vertex
fn corner(
    @location(0) position: vec2<f32>,
    @location(1) place: vec2<f32>,
    @location(2) color: vec4<f32>,
) -> Corner {
    return Corner(vec4(position, 0.0, 1.0), place, color);
}

fn written(color: vec3<f32>) -> vec4<f32> {
    if decodes {
        let high = pow((color + 0.055) / 1.055, vec3(2.4));
        return vec4(select(high, color / 12.92, color <= vec3(0.04045)), 1.0);
    }
    return vec4(color, 1.0);
}

@fragment
fn picture(in: Corner) -> @location(0) vec4<f32> {
    return written(textureSample(cells, between, in.place).rgb);
}

@fragment
fn even(in: Corner) -> @location(0) vec4<f32> {
    return written(in.color.rgb);
}
