// Adds the bytes of a stencil to the counts of the pixels that show something.

struct AddStencilParams {
    size: vec2<u32>,
    row_words: u32,
    // Whether the counts start at 0.
    first: u32,
}

struct Fragment {
    triangle: u32,
    second: f32,
    third: f32,
    depth: f32,
}

const NO_TRIANGLE: u32 = 0xffffffffu;

@group(0) @binding(0) var<uniform> params: AddStencilParams;
// A word holds four pixels, the leftmost in the lowest byte.
@group(0) @binding(1) var<storage, read> stencil: array<u32>;
@group(0) @binding(2) var<storage, read> fragments: array<Fragment>;
@group(0) @binding(3) var<storage, read_write> counts: array<i32>;

@compute @workgroup_size(8, 8)
fn add_stencil(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= params.size.x || id.y >= params.size.y {
        return;
    }
    let cell = id.y * params.size.x + id.x;
    var count = 0;
    if fragments[cell].triangle != NO_TRIANGLE {
        let word = stencil[id.y * params.row_words + id.x / 4u];
        count = i32(extractBits(word, 8u * (id.x % 4u), 8u));
    }
    if params.first == 0u {
        count += counts[cell];
    }
    counts[cell] = count;
}
