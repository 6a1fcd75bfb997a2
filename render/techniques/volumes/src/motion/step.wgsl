// Moves a volume over all sub-steps by one workgroup. Its threads stride over the particles. This
// is the twin of step.rs, forces.rs and star.rs.

struct StepParams {
    // Corner of the first cell of the surface, and boxes in one unit of the scene.
    lattice_low: vec3<f32>,
    boxes: f32,
    // Cells along x, y and z, and where places of samples begin in `surface`.
    lattice_sides: vec3<u32>,
    places_from: u32,
    pressure: f32,
    elastic: f32,
    cohesion: f32,
    keep: f32,
    pull: f32,
    cell: f32,
    inset: f32,
    seconds: f32,
    damping: f32,
    still: f32,
    height: f32,
    units: f32,
    boxes_from: u32,
    samples: u32,
    sub_steps: u32,
    seed: u32,
    weakest: f32,
    // Where the answers whether volumes are still begin in `marks`.
    stills_from: u32,
    padding: vec2<u32>,
}

struct MovedVolume {
    // The acceleration of all particles alike.
    constant: vec3<f32>,
    scale: f32,
    least_cone: f32,
    // Its particles, and where its neighbours and faces begin in `mesh`.
    first: u32,
    count: u32,
    neighbours: u32,
    faces: u32,
    face_count: u32,
    // Where its centres and radii, one each a sub-step, its pushes and its regions begin in
    // `numbers`.
    balls: u32,
    pushes: u32,
    push_count: u32,
    regions: u32,
    region_count: u32,
    padding: u32,
}

struct MovedParticle {
    place: vec3<f32>,
    distance: f32,
    velocity: vec3<f32>,
    sample: u32,
}

@group(0) @binding(0) var<uniform> params: StepParams;
@group(0) @binding(1) var<storage, read> volumes: array<MovedVolume>;
// Directions of the finest sphere, three words each. Then neighbours and faces of all spheres.
@group(0) @binding(2) var<storage, read> mesh: array<u32>;
@group(0) @binding(3) var<storage, read> numbers: array<f32>;
// Cells, boxes and places of the samples of the surface.
@group(0) @binding(4) var<storage, read> surface: array<u32>;
@group(0) @binding(5) var<storage, read_write> particles: array<MovedParticle>;
// Deviations from places of rest, with the resting radius.
@group(0) @binding(6) var<storage, read_write> deviations: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> marks: array<atomic<u32>>;

const THREADS: u32 = 64u;
const NEAREST: f32 = 0.03125;
const FARTHEST: f32 = 6.0;
const LEAST_POSITIVE: f32 = 1.17549435e-38;
const GREATEST: f32 = 3.4e38;
const HALF_WAY_ROUNDS: u32 = 8u;
const MOST_ROUNDS: u32 = 16u;

// Centre of the volume in the sub-step.
var<private> center: vec3<f32>;

var<workgroup> moving: atomic<u32>;
var<workgroup> failing: atomic<u32>;

fn direction(vertex: u32) -> vec3<f32> {
    let at = 3u * vertex;
    return bitcast<vec3<f32>>(vec3(mesh[at], mesh[at + 1u], mesh[at + 2u]));
}

fn deviate(volume: MovedVolume, radius: f32, thread: u32) {
    for (var i = thread; i < volume.count; i += THREADS) {
        let towards = direction(i);
        let resting = resting_radius(center, towards, radius, volume.scale);
        let at = volume.first + i;
        deviations[at] = vec4(particles[at].place - towards * resting, resting);
    }
}

fn cohesion(volume: MovedVolume, i: u32, own: vec3<f32>) -> vec3<f32> {
    let links = volume.neighbours + 6u * i;
    var sum = vec3(0.0);
    for (var link = links; link < links + 6u; link++) {
        sum += deviations[volume.first + mesh[link]].xyz;
    }
    // The first 12 vertices have five neighbours.
    return (sum - own * 6.0) * (params.cohesion / select(6.0, 5.0, i < 12u));
}

// The forces of the surroundings on a particle `from_center`, which the sample `sample` pulls.
fn around(volume: MovedVolume, from_center: vec3<f32>, sample: u32, radius: f32) -> vec3<f32> {
    let place = center + from_center;
    var force = vec3(0.0);
    if sample < params.samples {
        // From the centre, as places in the scene are too coarse for small volumes.
        force += surface_pull((place_of(sample) - center) - from_center, radius);
    }
    for (var i = 0u; i < volume.push_count; i++) {
        force += pushed(volume.pushes + 8u * i, place);
    }
    for (var i = 0u; i < volume.region_count; i++) {
        force += way_back(volume.regions + 8u * i, place, params.inset) * params.keep;
    }
    return force;
}

// A particle within its bounds. If it is not a number or has no direction, it goes to its place of
// rest.
fn bounded(moved: MovedParticle, nearest: f32, farthest: f32, rest: vec3<f32>) -> MovedParticle {
    let far = sqrt(dot(moved.place, moved.place));
    if far > LEAST_POSITIVE && far < GREATEST {
        if far >= nearest && far <= farthest {
            return MovedParticle(moved.place, far, moved.velocity, moved.sample);
        }
        let edge = select(farthest, nearest, far < nearest);
        let outward = moved.place * (1.0 / far);
        let slowed = moved.velocity - outward * dot(moved.velocity, outward);
        return MovedParticle(moved.place * (edge / far), edge, slowed, moved.sample);
    }
    return MovedParticle(rest, sqrt(dot(rest, rest)), vec3(0.0), moved.sample);
}

// Moves all particles. Returns whether one of this thread's still moves.
fn integrate(volume: MovedVolume, radius: f32, thread: u32) -> bool {
    let scaled = radius * volume.scale;
    let still = params.still * scaled;
    let most_force = (params.weakest * still) * (params.weakest * still);
    let most_speed = params.weakest * still * still;
    var moves = false;
    for (var i = thread; i < volume.count; i += THREADS) {
        let at = volume.first + i;
        var moved = particles[at];
        let deviation = deviations[at];
        let resting = deviation.w;
        let far = sqrt(dot(moved.place, moved.place));
        let outward = moved.place * (1.0 / far);
        if params.samples > 0u {
            moved.sample = pulling(center + moved.place, moved.sample);
        }
        let force = cohesion(volume, i, deviation.xyz)
            + around(volume, moved.place, moved.sample, radius)
            + volume.constant
            + outward * (params.pressure * (resting - far))
            + (outward * dot(deviation.xyz, outward) - deviation.xyz) * params.elastic;
        moved.velocity = (moved.velocity + force * params.seconds) * params.damping;
        moved.place += moved.velocity * params.seconds;
        let quiet = dot(force, force) <= most_force
            && dot(moved.velocity, moved.velocity) <= most_speed;
        moves = moves || !quiet;
        let rest = direction(i) * resting;
        particles[at] = bounded(moved, NEAREST * scaled, FARTHEST * scaled, rest);
    }
    return moves;
}

// Whether the cone over a face is too narrow.
fn fails(volume: MovedVolume, face: u32) -> bool {
    let at = volume.faces + 3u * face;
    let one = particles[volume.first + mesh[at]];
    let two = particles[volume.first + mesh[at + 1u]];
    let three = particles[volume.first + mesh[at + 2u]];
    let cone = dot(one.place, cross(two.place, three.place));
    return !(cone > volume.least_cone * (one.distance * two.distance * three.distance));
}

// Whether any cone is too narrow, after all threads have looked.
fn any_fails(volume: MovedVolume, thread: u32, marking: bool) -> bool {
    var found = false;
    for (var face = thread; face < volume.face_count; face += THREADS) {
        if fails(volume, face) {
            found = true;
            if marking {
                for (var corner = 0u; corner < 3u; corner++) {
                    let vertex = mesh[volume.faces + 3u * face + corner];
                    atomicStore(&marks[volume.first + vertex], 1u);
                }
            }
        }
    }
    if found {
        atomicOr(&failing, 1u);
    }
    let any = workgroupUniformLoad(&failing) != 0u;
    if thread == 0u {
        atomicStore(&failing, 0u);
    }
    return any;
}

// A corner half-way, or all the way, to the ray through its original direction, at its distance.
fn mended(place: vec3<f32>, far: f32, towards: vec3<f32>, half_way: bool) -> vec3<f32> {
    let ray = towards * far;
    let middle = place + ray;
    let size = sqrt(dot(middle, middle));
    if half_way && size > far / 1024.0 {
        return middle * (far / size);
    }
    return ray;
}

// Moves corners of faces whose cones fail, until none does.
fn mend(volume: MovedVolume, thread: u32) {
    for (var round_index = 0u; round_index <= MOST_ROUNDS; round_index++) {
        let all_move = round_index == MOST_ROUNDS;
        for (var i = thread; i < volume.count; i += THREADS) {
            atomicStore(&marks[volume.first + i], select(0u, 1u, all_move));
        }
        storageBarrier();
        let found = any_fails(volume, thread, true);
        storageBarrier();
        if !found && !all_move {
            break;
        }
        for (var i = thread; i < volume.count; i += THREADS) {
            let at = volume.first + i;
            if atomicLoad(&marks[at]) == 1u {
                let own = particles[at];
                let half_way = round_index < HALF_WAY_ROUNDS;
                particles[at].place = mended(own.place, own.distance, direction(i), half_way);
                particles[at].velocity = own.velocity * 0.5;
            }
        }
        storageBarrier();
    }
}

// Brings particles that passed a wall back to it along their rays, and takes their outward velocity.
fn keep_inside(volume: MovedVolume, radius: f32, thread: u32) {
    for (var i = thread; i < volume.count; i += THREADS) {
        let at = volume.first + i;
        let own = particles[at];
        var share = 1.0;
        for (var region = 0u; region < volume.region_count; region++) {
            share = min(share, share_inside(volume.regions + 8u * region, center, own.place));
        }
        if share < 1.0 {
            let far = sqrt(dot(own.place, own.place));
            let least = NEAREST * radius / 1024.0;
            let outward = own.place * (1.0 / far);
            let speed = max(dot(own.velocity, outward), 0.0);
            particles[at].place = outward * max(far * share * (1.0 - 1e-5), least);
            particles[at].velocity = own.velocity - outward * speed;
        }
    }
}

@compute @workgroup_size(64)
fn volumes_step(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let volume = volumes[group.x];
    var moves = false;
    for (var sub_step = 0u; sub_step < params.sub_steps; sub_step++) {
        let ball = volume.balls + 4u * sub_step;
        center = vec3(numbers[ball], numbers[ball + 1u], numbers[ball + 2u]);
        let radius = numbers[ball + 3u];
        deviate(volume, radius, thread);
        storageBarrier();
        moves = integrate(volume, radius, thread);
        storageBarrier();
        if any_fails(volume, thread, false) {
            mend(volume, thread);
            moves = true;
        }
        keep_inside(volume, radius, thread);
    }
    // Only the last sub-step decides.
    if moves {
        atomicOr(&moving, 1u);
    }
    let still = workgroupUniformLoad(&moving) == 0u;
    if thread == 0u && still {
        atomicStore(&marks[params.stills_from + group.x], 1u);
    }
}
