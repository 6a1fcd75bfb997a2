// Corners of a scene or of closed surfaces, as a camera without a far plane sees them.

struct FacesParams {
    clip_from_model: mat4x4<f32>,
    // Words from one vertex to the next. The first three are its position.
    vertex_words: u32,
    // Width of the picture in pixels.
    width: u32,
    // Divide the depth of fragments by this to get the depth of this camera.
    depth_scale: f32,
    spare: u32,
}

@group(0) @binding(0) var<uniform> params: FacesParams;
@group(0) @binding(1) var<storage, read> vertices: array<f32>;
// Indices of three corners, then of the surface.
@group(0) @binding(2) var<storage, read> triangles: array<vec4<u32>>;

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) surface: u32,
}

@vertex
fn corner(@builtin(vertex_index) index: u32) -> Corner {
    let triangle = triangles[index / 3u];
    let first = triangle[index % 3u] * params.vertex_words;
    let position = vec3(vertices[first], vertices[first + 1u], vertices[first + 2u]);
    return Corner(params.clip_from_model * vec4(position, 1.0), triangle.w);
}
