// Shades a visibility buffer in steps of light; twin of toon.rs. Follows textured.wgsl.

struct ToonParams {
    eye: vec3<f32>,
    strength: f32,
    // Direction towards the light, of length 1.
    light: vec3<f32>,
    // Samples along each side of a pixel.
    samples: u32,
    // Size of the picture in pixels.
    size: vec2<u32>,
    // Width and height of the shadow map; 0 without shadows.
    side: u32,
    // Darkness of cast shadows.
    shadow: f32,
    light_clip: array<vec4<f32>, 4>,
    // Near and far plane of the light, offset and tolerance.
    light_view: vec4<f32>,
    shadow_color: vec4<f32>,
    // To the right in the shadow map, and half the width of a border in its pixels.
    light_right: vec4<f32>,
    // Upwards in the shadow map, and the width of its pixel.
    light_up: vec4<f32>,
    greys: array<vec4<f32>, 64>,
}

// Cosine of the light below which shadows fade.
const GRAZING: f32 = 0.25;

@group(0) @binding(0) var<uniform> params: ToonParams;
@group(0) @binding(6) var<storage, read> shadows: array<Fragment>;
@group(0) @binding(7) var<storage, read_write> painted: array<vec4<f32>>;

fn grey(cosine: f32) -> f32 {
    let at = clamp(cosine, 0.0, 1.0) * 255.0;
    let below = min(u32(at), 254u);
    let low = params.greys[below / 4u][below % 4u];
    let high = params.greys[(below + 1u) / 4u][(below + 1u) % 4u];
    return low + (high - low) * (at - f32(below));
}

// 0 if the map shows a surface before `depth` in a pixel, otherwise 1.
fn free(column: u32, row: u32, depth: f32) -> f32 {
    let first = shadows[row * params.side + column].depth;
    return select(1.0, 0.0, first < 1.0 && first < depth);
}

// The weight of a pixel at `at` from `first` to `last`.
fn share(at: u32, first: u32, last: u32, part: f32) -> f32 {
    return select(select(1.0, part, at == last), 1.0 - part, at == first);
}

fn lit(own: vec3<f32>, normal: vec3<f32>, cosine: f32) -> f32 {
    let place = own + normal * params.light_view.z;
    let clip = params.light_clip[0] * place.x + params.light_clip[1] * place.y
        + params.light_clip[2] * place.z + params.light_clip[3];
    let side = f32(params.side);
    let soft = params.light_right.w;
    let x = (clip.x / clip.w + 1.0) / 2.0 * side - 0.5;
    let y = (1.0 - clip.y / clip.w) / 2.0 * side - 0.5;
    if !(x >= soft && y >= soft && x < side - 1.0 - soft && y < side - 1.0 - soft) {
        return 1.0;
    }
    let left = u32(x);
    let top = u32(y);
    let near = params.light_view.x;
    let far = params.light_view.y;
    let distance = clip.w - params.light_view.w;
    let scale = near * far / (far - near);
    let depth = far / (far - near) - scale / distance;
    let lean = scale / (distance * distance) * params.light_up.w / max(cosine, GRAZING);
    let slope = lean * vec2(dot(normal, params.light_right.xyz), -dot(normal, params.light_up.xyz));
    let around = u32(soft);
    let first = left - around;
    let last = left + around + 1u;
    let upper = top - around;
    let lower = top + around + 1u;
    var columns = array(first, left, last);
    var rows = array(upper, top, lower);
    var count = 0.0;
    for (var j = 0; j < 3; j++) {
        for (var i = 0; i < 3; i++) {
            let offset = vec2(f32(columns[i]) - x, f32(rows[j]) - y);
            count += free(columns[i], rows[j], depth + dot(slope, offset));
        }
    }
    if count == 0.0 || count == 9.0 {
        return count / 9.0;
    }
    var sum = 0.0;
    for (var row = upper; row <= lower; row++) {
        for (var column = first; column <= last; column++) {
            let offset = vec2(f32(column) - x, f32(row) - y);
            sum += share(column, first, last, x - f32(left)) * share(row, upper, lower, y - f32(top))
                * free(column, row, depth + dot(slope, offset));
        }
    }
    return sum / ((2.0 * soft + 1.0) * (2.0 * soft + 1.0));
}

// The triangle that was shaded last, and the share of light that reached it: samples of a pixel
// that show one triangle share it.
var<private> last_triangle: u32 = 0xffffffffu;
var<private> last_lit: f32 = 1.0;

fn toon(at: Fragment) -> vec3<f32> {
    let triangle = triangles[at.triangle];
    let a = vertices[triangle.x];
    let b = vertices[triangle.y];
    let c = vertices[triangle.z];
    let material = materials[triangle.w];
    let face = cross(b.position - a.position, c.position - a.position);
    var normal = between(at, a.normal, b.normal, c.normal);
    let far = length(normal);
    normal = select(vec3(0.0), normal / far, far > 0.0);
    if dot(face, params.eye - a.position) < 0.0 {
        normal = -normal;
    }
    var albedo = material.color * between(at, a.color, b.color, c.color);
    if material.width > 0u {
        let uv = vec2(a.u, a.v) + (vec2(b.u, b.v) - vec2(a.u, a.v)) * at.second
            + (vec2(c.u, c.v) - vec2(a.u, a.v)) * at.third;
        albedo *= textured(material, uv);
    }
    var cosine = dot(normal, params.light);
    if cosine > 0.0 && params.side > 0u {
        if last_triangle != at.triangle {
            let place = between(at, a.position, b.position, c.position);
            last_lit = lit(place, normal, cosine);
            last_triangle = at.triangle;
        }
        let shadow = params.shadow * (1.0 - last_lit) * min(cosine / GRAZING, 1.0);
        cosine *= 1.0 - shadow;
        let glaze = shadow * min(min(albedo.x, albedo.y), albedo.z);
        albedo *= mix(vec3(1.0), params.shadow_color.xyz, glaze);
    }
    let excess = max(params.strength * (0.5 - grey(cosine)), -1.0);
    return clamp(albedo * (1.0 - (1.0 - albedo) * excess), vec3(0.0), vec3(1.0));
}

@compute @workgroup_size(8, 8)
fn watercolor_toon(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.size) {
        return;
    }
    let stride = params.size.x * params.samples;
    var sum = vec4(0.0);
    for (var y = 0u; y < params.samples; y++) {
        for (var x = 0u; x < params.samples; x++) {
            let at = fragments[(id.y * params.samples + y) * stride + id.x * params.samples + x];
            if at.triangle != 0xffffffffu {
                sum += vec4(toon(at), 1.0);
            }
        }
    }
    var color = vec4(1.0, 1.0, 1.0, 0.0);
    if sum.w > 0.0 {
        color = vec4(sum.xyz / sum.w, sum.w / f32(params.samples * params.samples));
    }
    painted[id.y * params.size.x + id.x] = color;
}
