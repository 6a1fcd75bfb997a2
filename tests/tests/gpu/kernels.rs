//! Checks GPU kernels without an adapter (validity, bindings and layouts of structs), errors of the
//! graphics device (sizes beyond its limits, a lost device), and `impasto gpu` with the adapters
//! that it lists.

use documents::hint::Explain;
use graphics::field::Field;
use graphics::gpu::{BackendChoice, DeviceError, Kernel, Kind, Layout, Storage, adapters, best};
use graphics::surface::{STENCIL_FACES, WEIGHED_FACES};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{AddressSpace, StorageAccess, TypeInner};
use paint::engine::PaintEngine;
use paint::layer::Layer;
use suite::program::impasto;

/// The kernels of graphics, paint, watercolour, models in brushwork and paint volumes.
fn kernels() -> Vec<&'static Kernel> {
    let own = [graphics::kernels(), paint::engine::kernels()];
    [own.concat(), watercolor::kernels(), painterly::kernels(), volumes::kernels()].concat()
}

fn parsed(kernel: &Kernel) -> naga::Module {
    let parsed = naga::front::wgsl::parse_str(kernel.source);
    parsed
        .unwrap_or_else(|error| panic!("{}: {}", kernel.name, error.emit_to_string(kernel.source)))
}

#[test]
fn every_kernel_is_valid_in_the_base_profile() {
    for kernel in kernels() {
        let module = parsed(kernel);
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let valid = validator.validate(&module);
        assert!(valid.is_ok(), "{}: {valid:?}", kernel.name);
        let entry = module.entry_points.iter().find(|entry| entry.name == kernel.name);
        let size = entry.map(|entry| entry.workgroup_size);
        let invocations = size.map(|size| size.iter().product());
        assert_eq!(invocations, Some(64_u32), "{}", kernel.name);
        assert!(kernel.storage.len() <= 8, "{}: {:?}", kernel.name, kernel.storage);
    }
}

#[test]
fn every_kernel_is_bound_as_it_says() {
    for kernel in kernels() {
        let module = parsed(kernel);
        // Memory that a workgroup shares has no binding.
        let bound = module.global_variables.iter().map(|(_, v)| v).filter(|v| v.binding.is_some());
        let mut found: Vec<_> = bound.collect();
        found.sort_by_key(|variable| variable.binding.map(|binding| binding.binding));
        assert_eq!(found.len(), kernel.storage.len() + 1, "{}", kernel.name);
        assert_eq!(found[0].space, AddressSpace::Uniform, "{}", kernel.name);
        let name = module.types[found[0].ty].name.as_deref();
        assert_eq!(name, Some(kernel.parameters.name), "{}", kernel.name);
        for (variable, storage) in found[1..].iter().zip(kernel.storage) {
            let writes = match variable.space {
                AddressSpace::Storage { access } => access.contains(StorageAccess::STORE),
                _ => panic!("{}: {:?}", kernel.name, variable.name),
            };
            let says = *storage == Storage::Write;
            assert_eq!(writes, says, "{}: {:?}", kernel.name, variable.name);
        }
    }
}

/// Size in bytes of a WGSL struct, and its fields with their offsets as in a [`Layout`].
fn fields(module: &naga::Module, name: &str) -> Option<(u32, Vec<(String, usize)>)> {
    let mut types = module.types.iter().map(|(_, ty)| ty);
    let ty = types.find(|ty| ty.name.as_deref() == Some(name))?;
    let TypeInner::Struct { members, span } = &ty.inner else { return None };
    // An array of words does not fit uniforms, so each word of a padding has a name.
    let found = members
        .iter()
        .map(|m| (m.name.clone().unwrap(), m.offset as usize))
        .filter(|(name, _)| !name.starts_with("padding_"));
    Some((*span, found.collect()))
}

#[test]
fn structs_have_the_same_fields_in_both_languages() {
    for kernel in kernels() {
        let module = parsed(kernel);
        for layout in kernel.structs.iter().chain([&kernel.parameters]) {
            let Layout { name, bytes, fields: own } = *layout;
            let (span, found) = fields(&module, name)
                .unwrap_or_else(|| panic!("{}: no struct {name}", kernel.name));
            assert_eq!(span as usize, bytes, "{}: {name}", kernel.name);
            let own: Vec<_> = own.iter().map(|&(name, at)| (name.to_owned(), at)).collect();
            assert_eq!(found, own, "{}: {name}", kernel.name);
        }
    }
}

#[test]
fn shaders_that_count_faces_are_valid_and_bound_as_they_say() {
    let stencil = &STENCIL_FACES;
    let weighed = &WEIGHED_FACES;
    let no_structs: &[Layout] = &[];
    let shaders = [
        (stencil.source, stencil.parameters, no_structs, stencil.buffers),
        (weighed.source, weighed.parameters, weighed.structs, weighed.buffers),
    ];
    for (source, parameters, structs, buffers) in shaders {
        let module = naga::front::wgsl::parse_str(source).unwrap();
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let valid = validator.validate(&module);
        assert!(valid.is_ok(), "{valid:?}");
        assert_eq!(module.global_variables.len(), buffers + 1);
        for Layout { name, bytes, fields: own } in structs.iter().chain([&parameters]) {
            let (span, found) = fields(&module, name).unwrap();
            let own: Vec<_> = own.iter().map(|&(name, at)| (name.to_owned(), at)).collect();
            assert_eq!((span as usize, found), (*bytes, own), "{name}");
        }
    }
}

#[test]
fn a_canvas_beyond_the_device_is_told_with_both_sizes() {
    let Some(device) = crate::device() else { return };
    let limit = device.adapter().limits.binding_bytes;
    // The pigments of both films of this strip of cells, 64 bytes each, exceed the limit. The floor
    // has 4 bytes per cell.
    let cells = (limit / 64 + 1) as usize;
    if cells > 1 << 26 {
        return;
    }
    let error = PaintEngine::on_device(device, &Field::filled(cells, 1, 0)).unwrap_err();
    let bytes = 64 * cells as u64;
    assert_eq!(error, DeviceError::TooLarge { what: "the canvas", bytes, limit });
    assert_eq!(error.hint().unwrap().to_string(), "paint on the processor: `backend = cpu`");
}

#[test]
fn a_lost_device_is_an_error_of_every_call() {
    let Some(device) = crate::device() else { return };
    let mut engine = PaintEngine::on_device(device, &Field::filled(70, 70, 0)).unwrap();
    let brush = engine.add_brush(4, 4).unwrap();
    engine.device().unwrap().close();
    for found in [
        engine.set_wet(&Layer::empty(70, 70)),
        engine.set_brush_paint(brush, &Layer::empty(4, 4)),
        engine.wet().map(drop),
        engine.brush_paint(brush).map(drop),
        engine.dry(100),
        engine.floor().map(drop),
        engine.picture().map(drop),
        engine.add_brush(4, 4).map(drop),
        engine.finish(),
    ] {
        assert!(matches!(found, Err(DeviceError::Lost(..))), "{found:?}");
    }
}

#[test]
fn a_buffer_beyond_the_limit_is_refused() {
    let Some(device) = crate::device() else { return };
    let limit = device.adapter().limits.binding_bytes;
    let error = device.buffer("a test", limit + 1).unwrap_err();
    assert_eq!(error, DeviceError::TooLarge { what: "a test", bytes: limit + 1, limit });
}

#[test]
fn the_program_names_the_adapter_that_would_be_used() {
    let found = adapters();
    let run = impasto(&["gpu", "--json"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let json = run.json();
    let used = best(&found, BackendChoice::Auto).map(|adapter| adapter.name.as_str());
    let forced = best(&found, BackendChoice::Gpu).map(|adapter| adapter.name.as_str());
    assert_eq!(json["used"].as_str(), used);
    assert_eq!(json["with_backend_gpu"].as_str(), forced);
    let listed = json["adapters"].as_array().unwrap();
    assert_eq!(listed.len(), found.len());
    for (listed, adapter) in listed.iter().zip(&found) {
        let cells = listed["largest_canvas_cells"].as_u64().unwrap();
        let bytes = adapter.limits.binding_bytes;
        assert!(cells * 64 <= bytes && (cells + 1) * 64 > bytes, "{cells} of {bytes}");
    }
    let words = impasto(&["gpu"]);
    let first = words.out.lines().next().unwrap();
    let name = used.unwrap_or("the processor");
    assert!(first.starts_with(&format!("painting uses {name}: ")), "{first}");
}

#[test]
fn software_is_used_only_when_asked_for() {
    let found = adapters();
    let used = best(&found, BackendChoice::Auto);
    assert!(used.is_none_or(|adapter| adapter.kind != Kind::Software), "{used:?}");
    assert!(best(&found, BackendChoice::Cpu).is_none(), "the processor is not an adapter");
}
