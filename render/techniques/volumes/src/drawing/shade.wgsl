// Light, texture and hatching of each sample. This is the twin of shade.rs and follows ink.wgsl and textured.wgsl.

struct ShadeParams {
    eye: vec3<f32>,
    // Size of a pixel at distance 1 from the eye.
    pixel: f32,
    // Direction towards the light, of length 1.
    light: vec3<f32>,
    lit: u32,
    // Lowest corner of the model.
    origin: vec3<f32>,
    // Tiles of strokes per unit of the model.
    tiles: f32,
    size: vec2<u32>,
    // Cosine and sine of the strokes' angle.
    turn: vec2<f32>,
    shade: f32,
    rec601: u32,
    three_planes: u32,
    darkest: f32,
    inside: f32,
    outside: f32,
    pencil: f32,
    softness: f32,
    scale: f32,
    pale: f32,
    padding: f32,
    padding_1: f32,
    greys: array<vec4<f32>, 64>,
}

@group(0) @binding(0) var<uniform> params: ShadeParams;
@group(0) @binding(6) var<storage, read> quads: array<u32>;
@group(0) @binding(7) var<storage, read_write> shaded: array<vec4<f32>>;

fn grey(cosine: f32) -> f32 {
    let at = clamp(cosine, 0.0, 1.0) * 255.0;
    let below = min(u32(at), 254u);
    let low = params.greys[below / 4u][below % 4u];
    let high = params.greys[(below + 1u) / 4u][(below + 1u) % 4u];
    return low + (high - low) * (at - f32(below));
}

fn linear(value: f32) -> f32 {
    return select(pow((value + 0.055) / 1.055, 2.4), value / 12.92, value <= 0.04045);
}

fn grey_of(color: vec3<f32>) -> f32 {
    if params.rec601 == 1u {
        return dot(color, vec3(0.299, 0.587, 0.114));
    }
    let parts = vec3(linear(color.x), linear(color.y), linear(color.z));
    let y = clamp(dot(parts, vec3(0.2126, 0.7152, 0.0722)), 0.0, 1.0);
    return select(1.055 * pow(y, 1.0 / 2.4) - 0.055, 12.92 * y, y <= 0.0031308);
}

// Change of a value with this gradient from pixel to pixel, at most.
fn per_px(gradient: vec3<f32>, ray: vec3<f32>, normal: vec3<f32>, size: f32) -> f32 {
    let cosine = min(dot(ray, normal), -0.58);
    return length(gradient - normal * (dot(gradient, ray) / cosine)) * size;
}

fn side(component: f32) -> f32 {
    return select(1.0, -1.0, component < 0.0);
}

fn ink_of_plane(
    right: vec3<f32>,
    up: vec3<f32>,
    position: vec3<f32>,
    normal: vec3<f32>,
    tone: f32,
) -> f32 {
    let along_u = right * params.turn.x + up * params.turn.y;
    let along_v = up * params.turn.x - right * params.turn.y;
    let at = (position - params.origin) * params.tiles;
    let from_eye = position - params.eye;
    let ray = normalize(from_eye);
    let size = params.pixel * length(from_eye) * params.tiles;
    let across = per_px(2.0 * along_u + along_v, ray, normal, size);
    let change_v = per_px(along_v, ray, normal, size);
    let place = Patch(dot(along_u, at), dot(along_v, at), across, change_v, 1.0);
    return ink_on(place, tone, params.softness, params.scale);
}

fn ink_of_planes(position: vec3<f32>, normal: vec3<f32>, tone: f32) -> f32 {
    let facing = abs(normal);
    let least = 0.8 * max(facing.x, max(facing.y, facing.z));
    var weights = max(facing - least, vec3(0.0));
    weights /= max(weights.x + weights.y + weights.z, 1.17549435e-38);
    var ink = 0.0;
    if weights.x > 0.0 {
        let right = vec3(0.0, 0.0, -side(normal.x));
        ink += weights.x * ink_of_plane(right, vec3(0.0, 1.0, 0.0), position, normal, tone);
    }
    if weights.y > 0.0 {
        let up = vec3(0.0, 0.0, -side(normal.y));
        ink += weights.y * ink_of_plane(vec3(1.0, 0.0, 0.0), up, position, normal, tone);
    }
    if weights.z > 0.0 {
        let right = vec3(side(normal.z), 0.0, 0.0);
        ink += weights.z * ink_of_plane(right, vec3(0.0, 1.0, 0.0), position, normal, tone);
    }
    return min(ink, 1.0);
}

fn ink_of_texture(
    at: Fragment,
    corners: array<Vertex, 3>,
    position: vec3<f32>,
    normal: vec3<f32>,
    tone: f32,
) -> f32 {
    let a = corners[0];
    let b = corners[1];
    let c = corners[2];
    let to_b = b.position - a.position;
    let to_c = c.position - a.position;
    let face = cross(to_b, to_c);
    let area = dot(face, face);
    let by = select(0.0, 1.0 / area, area > 0.0);
    let of_b = cross(to_c, face) * by;
    let of_c = cross(face, to_b) * by;
    let du = vec2(b.u - a.u, c.u - a.u);
    let dv = vec2(b.v - a.v, c.v - a.v);
    let from_eye = position - params.eye;
    let ray = normalize(from_eye);
    let size = params.pixel * length(from_eye);
    let place = Patch(
        a.u + du.x * at.second + du.y * at.third,
        a.v + dv.x * at.second + dv.y * at.third,
        per_px(of_b * (2.0 * du.x + dv.x) + of_c * (2.0 * du.y + dv.y), ray, normal, size),
        per_px(of_b * dv.x + of_c * dv.y, ray, normal, size),
        1.0,
    );
    return ink_on(place, tone, params.softness, params.scale);
}

fn color_and_grey(at: Fragment) -> vec4<f32> {
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
    var color = material.color * between(at, a.color, b.color, c.color);
    if material.width > 0u {
        let uv = vec2(a.u, a.v) + (vec2(b.u, b.v) - vec2(a.u, a.v)) * at.second
            + (vec2(c.u, c.v) - vec2(a.u, a.v)) * at.third;
        color *= textured(material, uv);
    }
    var light = 0.0;
    if params.lit == 1u {
        light = grey(dot(normal, params.light));
        color *= 1.0 - params.shade * (1.0 - light);
    } else {
        let own = grey_of(color);
        light = grey(own * (2.0 - own));
    }
    let tone = params.darkest + (1.0 - params.darkest) * light;
    let position = between(at, a.position, b.position, c.position);
    var ink = 0.0;
    if params.three_planes == 1u {
        ink = ink_of_planes(position, normal, tone);
    } else {
        ink = ink_of_texture(at, array(a, b, c), position, normal, tone);
    }
    ink *= 1.0 - params.pencil;
    let outside = color * (1.0 - ink * params.outside);
    var drawn = grey_of(outside);
    if params.pale > 0.0 {
        let bare = grey_of(color);
        drawn = (bare + (1.0 - bare) * params.pale) * (1.0 - ink * params.outside);
    }
    return vec4(color * (1.0 - ink * params.inside), drawn);
}

@compute @workgroup_size(8, 8)
fn volumes_shade(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= params.size) {
        return;
    }
    let sample_at = id.y * params.size.x + id.x;
    let at = fragments[sample_at];
    if at.triangle == 0xffffffffu {
        shaded[sample_at] = vec4(1.0);
        return;
    }
    shaded[sample_at] = color_and_grey(at);
}
