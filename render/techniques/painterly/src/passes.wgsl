// The strokes of each pixel, weighed and summed; twin of square.rs, depths.rs and gather.rs. A
// workgroup is a square of pixels with its own list of strokes.

struct PassesParams {
    size: vec2<u32>,
    // Where the starts of the lists and the lists themselves begin in the batch.
    starts: u32,
    lists: u32,
    // How often weights are squared.
    squarings: u32,
    // Weight of the lowest furrow, before it is squared, by that of the highest ridge.
    furrow: f32,
    overhang: f32,
    thin: f32,
    // Value of a byte of 0 and change from byte to byte, by channel.
    low: vec4<f32>,
    step: vec4<f32>,
    rgb_from_xyz: array<vec4<f32>, 3>,
    white: vec3<f32>,
    coordinates: u32,
}

struct PackedStroke {
    // Centre in the picture.
    at: vec2<f32>,
    across: vec2<f32>,
    along: vec2<f32>,
    slope: vec2<f32>,
    // From the centre of the first texel.
    offset: vec2<f32>,
    extent: vec2<f32>,
    depth: f32,
    // 1 / tolerance.
    tightness: f32,
    weight: f32,
    // Part in the cover for a weight of 1.
    cover: f32,
    color: vec4<f32>,
    // First texel of the tone, and width of the tile.
    texels: vec2<u32>,
    spare: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: PassesParams;
@group(0) @binding(1) var<storage, read> depths: array<f32>;
@group(0) @binding(2) var<storage, read> strokes: array<PackedStroke>;
@group(0) @binding(3) var<storage, read> batch: array<u32>;
@group(0) @binding(4) var<storage, read> texels: array<u32>;
// Encoded values of linear ones in even steps.
@group(0) @binding(5) var<storage, read> encoded_values: array<f32>;
@group(0) @binding(6) var<storage, read_write> colors: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> heights: array<f32>;

const NEGLIGIBLE: f32 = 1.0 / 256.0;
const SCALE: f32 = 8.0;
const LOST: f32 = 1e-30;
const BOWL: f32 = 0.1;
const NOTHING: f32 = 1.0;
const FAR: f32 = 3e38;

// What the strokes of one surface sum up to.
struct Sums {
    // Bytes of the map times 256, times weights.
    bytes: vec4<f32>,
    // Colours of the strokes times weights.
    color: vec3<f32>,
    weight: f32,
    cover: f32,
}

struct Gathered {
    on: Sums,
    before: Sums,
}

// exp(-4.5 x) brought to 0 at x = 1 and beyond.
fn bell(square: f32) -> f32 {
    const MIDDLE: f32 = 0.5697828;
    const END: f32 = 0.0111425;
    let t = -1.125 * (square - 0.5);
    let root = MIDDLE * (1.0 + t * (1.0 + t * (0.5 + t * (1.0 / 6.0 + t * (1.0 / 24.0)))));
    let second = root * root;
    let bell = max((second * second - END) * (1.0 / (1.0 - END)), 0.0);
    return select(0.0, bell, square < 1.0);
}

// Weight of a stroke at a place about its centre, before it is raised to a power.
fn shape(stroke: PackedStroke, place: vec2<f32>) -> f32 {
    let a = dot(stroke.across, place);
    let b = dot(stroke.along, place);
    return stroke.weight * bell(a * a + b * b);
}

// Depth of the plane of a stroke.
fn plane(stroke: PackedStroke, place: vec2<f32>) -> f32 {
    return stroke.depth + dot(stroke.slope, place);
}

// Shares of a stroke on the mesh of this depth, and before it.
fn shares(stroke: PackedStroke, plane: f32, depth: f32) -> vec2<f32> {
    let before = (depth - plane) * stroke.tightness;
    let close = clamp(2.0 - abs(before), 0.0, 1.0);
    let on = select(0.0, close, depth < NOTHING);
    return vec2(on, select(0.0, 1.0 - on, before > 0.0));
}

// The depth at which a stroke of this weight counts: its plane, bent back where it is low.
fn bowl(stroke: PackedStroke, plane: f32, weight: f32) -> f32 {
    return plane + BOWL / stroke.tightness * (1.0 / max(weight, 1e-6) - 1.0);
}

// Share with which a stroke belongs to the nearest surface.
fn nearness(stroke: PackedStroke, bowl: f32, nearest: f32) -> f32 {
    return clamp(2.0 - (bowl - nearest) * stroke.tightness, 0.0, 1.0);
}

fn powered(shape: f32) -> f32 {
    var weight = shape * SCALE;
    for (var i = 0u; i < params.squarings; i++) {
        weight *= weight;
    }
    return weight;
}

// The four bytes of a texel in lanes of 16 bits: channels 0 and 1, then 2 and 3.
fn spread(at: u32) -> vec2<u32> {
    let texel = texels[at];
    return vec2(texel, texel >> 8u) & vec2(0x00ff00ffu);
}

// Two texels of a row, the right one with a share of 256ths, rounded to bytes.
fn mixed(left: vec2<u32>, right: vec2<u32>, share: u32) -> vec2<u32> {
    let sum = left * (256u - share) + right * share + vec2(0x00800080u);
    return (sum >> vec2(8u)) & vec2(0x00ff00ffu);
}

// What a stroke shows of the map: interpolated bytes times 256.
fn shown_bytes(stroke: PackedStroke, place: vec2<f32>) -> vec4<f32> {
    let start = stroke.texels.x;
    let size = stroke.texels.y;
    let way = vec2(dot(stroke.across, place), dot(stroke.along, place));
    let whole = stroke.offset + stroke.extent * way;
    let at = (whole - floor(whole)) * f32(size);
    let texel = min(floor(at), vec2(f32(size) - 1.0));
    let share = vec2<u32>(256.0 * min(at - texel, vec2(1.0)));
    let corner = vec2<u32>(texel);
    let first = start + corner.y * (size + 1u) + corner.x;
    let below = first + size + 1u;
    let upper = mixed(spread(first), spread(first + 1u), share.x);
    let lower = mixed(spread(below), spread(below + 1u), share.x);
    let sum = upper * (256u - share.y) + lower * share.y;
    let lanes = vec4(sum.x & 0xffffu, sum.x >> 16u, sum.y & 0xffffu, sum.y >> 16u);
    return vec4<f32>(lanes);
}

fn add(sums: ptr<function, Sums>, stroke: PackedStroke, bytes: vec4<f32>, weight: f32) {
    (*sums).bytes += bytes * weight;
    (*sums).color += stroke.color.xyz * weight;
    (*sums).weight += weight;
}

// Passes 1 and 2 for the pixel with this centre and depth; `list` is the range of its strokes.
fn gather(centre: vec2<f32>, depth: f32, list: vec2<u32>) -> Gathered {
    var nearest = FAR;
    var total = vec2(0.0);
    var cover = vec2(0.0);
    for (var i = list.x; i < list.y; i++) {
        let stroke = strokes[batch[i]];
        let place = centre - stroke.at;
        let shape = shape(stroke, place);
        if shape > 0.0 {
            let plane = plane(stroke, place);
            let share = shares(stroke, plane, depth);
            total.x += powered(shape) * share.x;
            cover.x += shape * share.x * stroke.cover;
            if share.y > 0.0 {
                nearest = min(nearest, bowl(stroke, plane, shape * share.y));
            }
        }
    }
    if nearest < FAR {
        for (var i = list.x; i < list.y; i++) {
            let stroke = strokes[batch[i]];
            let place = centre - stroke.at;
            let shape = shape(stroke, place);
            let plane = plane(stroke, place);
            let share = shares(stroke, plane, depth).y;
            if shape > 0.0 && share > 0.0 {
                let near = share * nearness(stroke, bowl(stroke, plane, shape * share), nearest);
                total.y += powered(shape) * near;
                cover.y += shape * near * stroke.cover;
            }
        }
    }
    var on = Sums();
    var before = Sums();
    on.cover = cover.x;
    before.cover = cover.y;
    // Maps without relief have a height of 0 everywhere.
    let furrow = select(1.0, params.furrow, params.step.w > 0.0);
    let ridges = (1.0 - furrow) / (256.0 * 255.0);
    for (var i = list.x; i < list.y; i++) {
        let stroke = strokes[batch[i]];
        let place = centre - stroke.at;
        let shape = shape(stroke, place);
        if shape <= 0.0 {
            continue;
        }
        let plane = plane(stroke, place);
        var share = shares(stroke, plane, depth);
        if share.y > 0.0 {
            share.y *= nearness(stroke, bowl(stroke, plane, shape * share.y), nearest);
        }
        let own = max(powered(shape) * share - total * NEGLIGIBLE, vec2(0.0));
        if any(own > vec2(0.0)) {
            let bytes = shown_bytes(stroke, place);
            let high = furrow + bytes.w * ridges;
            let weight = own * high * high;
            add(&on, stroke, bytes, weight.x);
            add(&before, stroke, bytes, weight.y);
        }
    }
    return Gathered(on, before);
}

@compute @workgroup_size(8, 8)
fn painterly_passes(
    @builtin(global_invocation_id) at: vec3<u32>,
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
) {
    if any(at.xy >= params.size) {
        return;
    }
    let pixel = at.y * params.size.x + at.x;
    let square = params.starts + group.y * groups.x + group.x;
    let list = params.lists + vec2(batch[square], batch[square + 1u]);
    let depth = depths[pixel];
    let gathered = gather(vec2<f32>(at.xy) + 0.5, depth, list);
    let shown = divided(gathered, depth < NOTHING);
    colors[pixel] = shown.color;
    heights[pixel] = shown.height;
}
