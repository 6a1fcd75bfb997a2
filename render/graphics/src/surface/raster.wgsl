// Draws the visibility buffer of a mesh. This is the twin of raster.rs.

struct RasterParams {
    clip_from_model: mat4x4<f32>,
}

struct Vertex {
    position: vec3<f32>,
    u: f32,
    normal: vec3<f32>,
    v: f32,
    color: vec3<f32>,
    spare: f32,
}

@group(0) @binding(0) var<uniform> params: RasterParams;
@group(0) @binding(1) var<storage, read> vertices: array<Vertex>;
// Indices of three corners, then of the material.
@group(0) @binding(2) var<storage, read> triangles: array<vec4<u32>>;

struct Corner {
    @builtin(position) position: vec4<f32>,
    // Barycentric weights of the second and the third corner.
    @location(0) weights: vec2<f32>,
    @location(1) @interpolate(flat) triangle: u32,
}

@vertex
fn corner(@builtin(vertex_index) index: u32) -> Corner {
    let triangle = index / 3u;
    let which = index % 3u;
    let position = vertices[triangles[triangle][which]].position;
    let weights = vec2(f32(which == 1u), f32(which == 2u));
    return Corner(params.clip_from_model * vec4(position, 1.0), weights, triangle);
}

@fragment
fn pixel(at: Corner) -> @location(0) vec4<u32> {
    return vec4(at.triangle, bitcast<vec2<u32>>(at.weights), bitcast<u32>(at.position.z));
}
