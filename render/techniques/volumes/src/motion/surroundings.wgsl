// The pushes, regions and samples of the surface around a particle. This is the twin of forces.rs
// and surface_lattice.rs. You find them in `numbers`, eight to a push or region, and in `surface`.

const NONE: u32 = 0xffffffffu;
const BOXES: u32 = 4u;

fn triple(at: u32) -> vec3<f32> {
    return vec3(numbers[at], numbers[at + 1u], numbers[at + 2u]);
}

// The acceleration of a particle at `place` by the push at `at`.
fn pushed(at: u32, place: vec3<f32>) -> vec3<f32> {
    let way = (place - triple(at)) / numbers[at + 3u];
    let strength = 1.0 - dot(way, way);
    if strength <= 0.0 {
        return vec3(0.0);
    }
    return triple(at + 4u) * (numbers[at + 7u] * params.cell * strength);
}

// The way from `place` to the nearest point that is `inset` inside of the region at `at`.
fn way_back(at: u32, place: vec3<f32>, inset: f32) -> vec3<f32> {
    let first = triple(at + 1u);
    let second = triple(at + 4u);
    if numbers[at] == 0.0 {
        let middle = (first + second) * 0.5;
        let low = min(first + inset, middle);
        let high = max(second - inset, middle);
        return min(max(place, low), high) - place;
    }
    let way = place - first;
    if numbers[at] == 1.0 {
        let far = sqrt(dot(way, way));
        let most = max(second.x - inset, 0.0);
        if far > most {
            return way * (most / far - 1.0);
        }
        return vec3(0.0);
    }
    return second * max(inset - dot(way, second), 0.0);
}

// The share of a way of `length` towards a wall that `room` allows, at most `share`.
fn within(room: f32, length: f32, share: f32) -> f32 {
    if room <= 0.0 {
        return 0.0;
    }
    if length * share > room {
        return room / length;
    }
    return share;
}

// The greatest share of the way from `center` by `offset` that lies inside of the region at `at`.
fn share_inside(at: u32, center: vec3<f32>, offset: vec3<f32>) -> f32 {
    let first = triple(at + 1u);
    let second = triple(at + 4u);
    if numbers[at] == 0.0 {
        let rise = second - center;
        let fall = center - first;
        var share = within(rise.x, offset.x, 1.0);
        share = within(fall.x, -offset.x, share);
        share = within(rise.y, offset.y, share);
        share = within(fall.y, -offset.y, share);
        share = within(rise.z, offset.z, share);
        return within(fall.z, -offset.z, share);
    }
    let way = center - first;
    if numbers[at] == 1.0 {
        let room = second.x * second.x - dot(way, way);
        let square = dot(offset, offset);
        let along = dot(way, offset);
        if room <= 0.0 {
            return 0.0;
        }
        if square + 2.0 * along <= room {
            return 1.0;
        }
        let root = sqrt(along * along + square * room);
        if along > 0.0 {
            return room / (along + root);
        }
        return (root - along) / square;
    }
    return within(dot(way, second), -dot(offset, second), 1.0);
}

// Index of the sample for `place`, or `NONE`.
fn sample_of(place: vec3<f32>) -> u32 {
    let at = (place - params.lattice_low) * params.boxes;
    let sides = params.lattice_sides;
    if !(all(at >= vec3(0.0)) && all(at < vec3<f32>(sides * BOXES))) {
        return NONE;
    }
    let box_at = vec3<u32>(at);
    let cell = box_at / BOXES;
    let table = surface[(cell.z * sides.y + cell.y) * sides.x + cell.x];
    if table == NONE {
        return NONE;
    }
    let inside = box_at % BOXES;
    let of_cell = (inside.z * BOXES + inside.y) * BOXES + inside.x;
    return surface[params.boxes_from + table * BOXES * BOXES * BOXES + of_cell];
}

fn place_of(sample: u32) -> vec3<f32> {
    let at = params.places_from + 3u * sample;
    return bitcast<vec3<f32>>(vec3(surface[at], surface[at + 1u], surface[at + 2u]));
}

// Index of the sample that pulls a particle at `place`, which `last` pulled before.
fn pulling(place: vec3<f32>, last: u32) -> u32 {
    let found = sample_of(place);
    if last >= params.samples {
        return found;
    }
    if found >= params.samples {
        return last;
    }
    let new_way = place_of(found) - place;
    let old_way = place_of(last) - place;
    return select(last, found, dot(new_way, new_way) < dot(old_way, old_way));
}

// The pull of a sample that is `way` from the particle.
fn surface_pull(way: vec3<f32>, radius: f32) -> vec3<f32> {
    let square = dot(way, way);
    if square >= params.cell * params.cell {
        return vec3(0.0);
    }
    if square > radius * radius {
        return way * (params.pull * radius / sqrt(square));
    }
    return way * params.pull;
}
