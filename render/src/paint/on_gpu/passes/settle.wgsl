// The head's paint after a sub-step: what it had and what it gained.

@group(0) @binding(0) var<uniform> now: Step;
@group(0) @binding(1) var<storage, read_write> gained: array<u32>;
@group(0) @binding(2) var<storage, read_write> brush_pigments: array<u32>;
@group(0) @binding(3) var<storage, read_write> brush_vehicle: array<u32>;

@compute @workgroup_size(8, 8)
fn settle_brush(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let b = 64u * group.x + local;
    if b >= now.brush_cells {
        return;
    }
    for (var i = 0u; i < 8u; i++) {
        brush_pigments[8u * b + i] += gained[9u * b + i];
        gained[9u * b + i] = 0u;
    }
    brush_vehicle[b] += gained[9u * b + 8u];
    gained[9u * b + 8u] = 0u;
}
