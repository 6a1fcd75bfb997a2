// Wet paint drying from the bottom, and dry paint put on or taken away.

struct Drying {
    canvas: vec2<u32>,
    // Of 65536 parts, those that dry.
    parts: u32,
    // 1 where the layer raises what is below the wet paint, -1 where it is taken away.
    rise: i32,
}

@group(0) @binding(0) var<uniform> now: Drying;
@group(0) @binding(1) var<storage, read_write> ground: array<i32>;
@group(0) @binding(2) var<storage, read_write> dry_pigments: array<vec4<u32>>;
@group(0) @binding(3) var<storage, read_write> dry_vehicle: array<u32>;
@group(0) @binding(4) var<storage, read_write> pigments: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read_write> vehicle: array<u32>;

// The new layer is a share of the wet paint.
@compute @workgroup_size(8, 8)
fn dry_cells(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= now.canvas) {
        return;
    }
    let i = id.y * now.canvas.x + id.x;
    let wet = Cell(pigments[2u * i], pigments[2u * i + 1u], vehicle[i]);
    let dried = share(wet, now.parts);
    let left = minus(wet, dried);
    pigments[2u * i] = left.low;
    pigments[2u * i + 1u] = left.high;
    vehicle[i] = left.vehicle;
    dry_pigments[2u * i] = dried.low;
    dry_pigments[2u * i + 1u] = dried.high;
    dry_vehicle[i] = dried.vehicle;
    ground[i] += now.rise * bitcast<i32>(volume(dried));
}

// The layer is there already.
@compute @workgroup_size(8, 8)
fn raise_ground(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= now.canvas) {
        return;
    }
    let i = id.y * now.canvas.x + id.x;
    let dried = Cell(dry_pigments[2u * i], dry_pigments[2u * i + 1u], dry_vehicle[i]);
    ground[i] += now.rise * bitcast<i32>(volume(dried));
}
