// One step of spilling in whole quanta. This is the twin of spill.rs. Products of 64 bits are two
// words, the high one first.

struct SpillParams {
    // Shares that cross a face, an edge and a corner, in parts of 65536.
    rates: vec3<u32>,
    // Number of cells.
    count: u32,
    births: u32,
    uneven: u32,
    padding: vec2<u32>,
}

@group(0) @binding(0) var<uniform> params: SpillParams;
// Index of the first link of each cell, and at the end the number of links. Then two words for
// each link: the cell at its other end, with its axes in the two highest bits, and the same link
// from there.
@group(0) @binding(1) var<storage, read> graph: array<u32>;
// Capacity and lift of each cell.
@group(0) @binding(2) var<storage, read> cells: array<vec2<u32>>;
// Eight pigments and vehicle of each cell.
@group(0) @binding(3) var<storage, read> paint: array<u32>;
// Volume and head of each cell.
@group(0) @binding(4) var<storage, read_write> measured: array<vec2<u32>>;
// Gifts along each link as a share of the giver's paint. Then, for each cell, the share of what it
// is offered that it has room for.
@group(0) @binding(5) var<storage, read_write> shares: array<u32>;
// Paint of each cell after the step, and as a tenth word the neighbour that gave a dry one most.
@group(0) @binding(6) var<storage, read_write> next: array<u32>;
// The highest head.
@group(0) @binding(7) var<storage, read_write> highest: array<atomic<u32>>;

const ONE: u32 = 65536u;
const AMOUNTS: u32 = 9u;
const NONE: u32 = 0xffffffffu;
const MOST_FILMS: u32 = 16u;
const MOST_HEAD: u32 = 0x40000000u;

fn product(a: u32, b: u32) -> vec2<u32> {
    let low = (a & 0xffffu) * (b & 0xffffu);
    let one = (a >> 16u) * (b & 0xffffu);
    let other = (a & 0xffffu) * (b >> 16u);
    let middle = (low >> 16u) + (one & 0xffffu) + (other & 0xffffu);
    let high = (a >> 16u) * (b >> 16u) + (one >> 16u) + (other >> 16u) + (middle >> 16u);
    return vec2(high, (middle << 16u) | (low & 0xffffu));
}

fn sum_of(a: vec2<u32>, b: u32) -> vec2<u32> {
    let low = a.y + b;
    return vec2(a.x + select(0u, 1u, low < b), low);
}

fn is_less(a: vec2<u32>, b: vec2<u32>) -> bool {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
}

// `part / whole`, rounded down, for a quotient below 2^32 and a whole above 0 and below 2^63.
fn quotient(part: vec2<u32>, whole: vec2<u32>) -> u32 {
    if part.x == 0u && whole.x == 0u {
        return part.y / whole.y;
    }
    // Long division: as the quotient has 32 bits, the high word is less than the whole.
    var rest = vec2(0u, part.x);
    var found = 0u;
    for (var bit = 32u; bit > 0u; bit--) {
        let next_bit = (part.y >> (bit - 1u)) & 1u;
        rest = vec2((rest.x << 1u) | (rest.y >> 31u), (rest.y << 1u) | next_bit);
        found = found << 1u;
        if !is_less(rest, whole) {
            let borrow = select(0u, 1u, rest.y < whole.y);
            rest = vec2(rest.x - whole.x - borrow, rest.y - whole.y);
            found |= 1u;
        }
    }
    return found;
}

fn first_link(cell: u32) -> u32 {
    return graph[cell];
}

fn other_end(link: u32) -> u32 {
    return graph[params.count + 1u + 2u * link] & 0x3fffffffu;
}

fn rate_of(link: u32) -> u32 {
    return params.rates[(graph[params.count + 1u + 2u * link] >> 30u) - 1u];
}

fn back_link(link: u32) -> u32 {
    return graph[params.count + 2u + 2u * link];
}

// Index in `shares` of what a cell accepts.
fn accepted_at(cell: u32) -> u32 {
    return graph[params.count] + cell;
}

fn room(capacity: u32) -> u32 {
    return select(capacity * MOST_FILMS, MAX_COLUMN, capacity >= MAX_COLUMN / MOST_FILMS);
}

@compute @workgroup_size(64)
fn volumes_spill_measure(@builtin(global_invocation_id) id: vec3<u32>) {
    let cell = id.x;
    if cell >= params.count {
        return;
    }
    var sum = 0u;
    for (var slot = 0u; slot < AMOUNTS; slot++) {
        sum += paint[AMOUNTS * cell + slot];
    }
    let capacity = max(cells[cell].x, 1u);
    var films = MOST_HEAD;
    if (sum >> 14u) < capacity {
        films = quotient(vec2(sum >> 16u, sum << 16u), vec2(0u, capacity));
    }
    let head = cells[cell].y + films;
    measured[cell] = vec2(sum, head);
    atomicMax(&highest[0], head);
}

@compute @workgroup_size(64)
fn volumes_spill_offer(@builtin(global_invocation_id) id: vec3<u32>) {
    let cell = id.x;
    if cell >= params.count {
        return;
    }
    let own = measured[cell];
    let capacity = cells[cell].x;
    let end = first_link(cell + 1u);
    if own.x <= capacity {
        for (var link = first_link(cell); link < end; link++) {
            shares[link] = 0u;
        }
        return;
    }
    var sum = vec2(0u);
    for (var link = first_link(cell); link < end; link++) {
        let other = other_end(link);
        let theirs = measured[other];
        var wanted = 0u;
        if own.y > theirs.y && (params.births == 1u || theirs.x > 0u) {
            let smaller = min(capacity, cells[other].x);
            let rated = product(min(own.y - theirs.y, MOST_FILMS * ONE), rate_of(link));
            wanted = rated.x * smaller + product(rated.y, smaller).x;
        }
        sum = sum_of(sum, wanted);
        shares[link] = wanted;
    }
    let excess = own.x - capacity;
    for (var link = first_link(cell); link < end; link++) {
        var share = shares[link];
        if share > 0u {
            if is_less(vec2(0u, excess), sum) {
                share = quotient(product(excess, share), sum);
            }
            shares[link] = ratio_of_65536(share, own.x);
        }
    }
}

@compute @workgroup_size(64)
fn volumes_spill_accept(@builtin(global_invocation_id) id: vec3<u32>) {
    let cell = id.x;
    if cell >= params.count {
        return;
    }
    var accepted = ONE;
    // A level cell never rises above its highest neighbour, except for rounding.
    if params.uneven == 1u || atomicLoad(&highest[0]) >= (MOST_FILMS - 1u) * ONE {
        var offered = vec2(0u);
        for (var link = first_link(cell); link < first_link(cell + 1u); link++) {
            let share = shares[back_link(link)];
            let offer = share_of_65536(measured[other_end(link)].x, share);
            offered = sum_of(offered, offer + select(0u, 1u, share > 0u));
        }
        let most = room(cells[cell].x);
        let free = max(most, measured[cell].x) - measured[cell].x;
        if is_less(vec2(0u, free), offered) {
            accepted = quotient(vec2(free >> 16u, free << 16u), offered);
        }
    }
    shares[accepted_at(cell)] = accepted;
}

@compute @workgroup_size(64)
fn volumes_spill_gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let cell = id.x;
    if cell >= params.count {
        return;
    }
    let own = AMOUNTS * cell;
    var sums: array<u32, 9>;
    for (var slot = 0u; slot < AMOUNTS; slot++) {
        sums[slot] = paint[own + slot];
    }
    var most = 0u;
    var giver = NONE;
    for (var link = first_link(cell); link < first_link(cell + 1u); link++) {
        let other = other_end(link);
        let given = shares[link];
        let taken = shares[back_link(link)];
        // Paint flows one way, from the higher head to the lower.
        if given > 0u {
            let share = share_of_65536(given, shares[accepted_at(other)]);
            for (var slot = 0u; slot < AMOUNTS; slot++) {
                sums[slot] -= share_of_65536(paint[own + slot], share);
            }
        } else if taken > 0u {
            let share = share_of_65536(taken, shares[accepted_at(cell)]);
            var part = 0u;
            for (var slot = 0u; slot < AMOUNTS; slot++) {
                let amount = share_of_65536(paint[AMOUNTS * other + slot], share);
                sums[slot] += amount;
                part += amount;
            }
            if measured[cell].x == 0u && part > most {
                most = part;
                giver = other;
            }
        }
    }
    for (var slot = 0u; slot < AMOUNTS; slot++) {
        next[(AMOUNTS + 1u) * cell + slot] = sums[slot];
    }
    next[(AMOUNTS + 1u) * cell + AMOUNTS] = giver;
}
