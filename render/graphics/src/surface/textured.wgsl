// Vertices, materials and textures of a model as a kernel reads them at the fragments of a visibility buffer.

struct Vertex {
    position: vec3<f32>,
    u: f32,
    normal: vec3<f32>,
    v: f32,
    color: vec3<f32>,
    spare: f32,
}

struct PackedMaterial {
    color: vec3<f32>,
    first: u32,
    width: u32,
    height: u32,
    spare: vec2<u32>,
}

struct Fragment {
    triangle: u32,
    second: f32,
    third: f32,
    depth: f32,
}

@group(0) @binding(1) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(2) var<storage, read> triangles: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read> materials: array<PackedMaterial>;
@group(0) @binding(4) var<storage, read> texels: array<u32>;
@group(0) @binding(5) var<storage, read> fragments: array<Fragment>;

fn between(at: Fragment, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    return a + (b - a) * at.second + (c - a) * at.third;
}

fn texel(material: PackedMaterial, column: u32, row: u32) -> vec3<f32> {
    return unpack4x8unorm(texels[material.first + row * material.width + column]).xyz;
}

// The index of the texel at `place`, which is -1 to `count`, in a row of `count` texels that
// repeats.
fn wrapped(place: f32, count: u32) -> u32 {
    let whole = floor(place);
    if whole < 0.0 {
        return count - 1u;
    }
    return select(u32(whole), 0u, whole >= f32(count));
}

fn textured(material: PackedMaterial, at: vec2<f32>) -> vec3<f32> {
    let place = at - floor(at);
    let x = place.x * f32(material.width) - 0.5;
    let y = place.y * f32(material.height) - 0.5;
    let left = wrapped(x, material.width);
    let right = wrapped(x + 1.0, material.width);
    let top = wrapped(y, material.height);
    let bottom = wrapped(y + 1.0, material.height);
    let above = mix(texel(material, left, top), texel(material, right, top), x - floor(x));
    let below = mix(texel(material, left, bottom), texel(material, right, bottom), x - floor(x));
    return mix(above, below, y - floor(y));
}
