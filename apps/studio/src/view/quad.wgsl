// Draws textured and coloured quads, and the meshes of the interface. It has no options beyond that, because a software
// driver executes every line of a shader for every pixel.

// The target encodes what is written, so values are decoded to linear light first.
override output_is_linear: bool = false;

struct Vertex {
    @builtin(position) position: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) color: vec4<f32>,
}

@group(0) @binding(0) var cells: texture_2d<f32>;
@group(0) @binding(1) var cell_sampler: sampler;

@vertex
fn vertex_main(
    @location(0) position: vec2<f32>,
    @location(1) uv: vec2<f32>,
    @location(2) color: vec4<f32>,
) -> Vertex {
    return Vertex(vec4(position, 0.0, 1.0), uv, color);
}

fn output(color: vec3<f32>) -> vec4<f32> {
    return translucent(vec4(color, 1.0));
}

fn translucent(color: vec4<f32>) -> vec4<f32> {
    if output_is_linear {
        let high = pow((color.rgb + 0.055) / 1.055, vec3(2.4));
        return vec4(select(high, color.rgb / 12.92, color.rgb <= vec3(0.04045)), color.a);
    }
    return color;
}

@fragment
fn textured(in: Vertex) -> @location(0) vec4<f32> {
    return output(textureSample(cells, cell_sampler, in.uv).rgb);
}

@fragment
fn blended(in: Vertex) -> @location(0) vec4<f32> {
    return translucent(textureSample(cells, cell_sampler, in.uv) * in.color);
}

@fragment
fn flat_color(in: Vertex) -> @location(0) vec4<f32> {
    return output(in.color.rgb);
}
