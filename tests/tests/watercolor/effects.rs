//! Effects, and both backends.

use render::field::Field;
use render::watercolor::{Backend, OnCpu, OnGpu};
use suite::adapter::device;

#[test]
fn pictures_come_back_from_both_backends() {
    let field = Field::from_values(3, 2, (0..6).map(|i| [i as f32 / 8.0; 4]).collect());
    let on_cpu = OnCpu.colour_of(&field).unwrap();
    assert_eq!(OnCpu.colour_field(&on_cpu).unwrap(), field);
    let Some(mut on_gpu) = device().map(OnGpu::new) else { return };
    let there = on_gpu.colour_of(&field).unwrap();
    assert_eq!(on_gpu.colour_field(&there).unwrap(), field);
}
