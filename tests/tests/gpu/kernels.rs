//! Checks of GPU kernels without an adapter: validity, bindings and layouts of structs.

use graphics::gpu::{Kernel, Layout, Storage};
use graphics::surface::{STENCIL_FACES, WEIGHED_FACES};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{AddressSpace, StorageAccess, TypeInner};

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
        // Memory that a workgroup shares is bound to nothing.
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

/// Size in bytes of a WGSL struct, and its fields with their offsets, as a [`Layout`] has them.
fn fields(module: &naga::Module, name: &str) -> Option<(u32, Vec<(String, usize)>)> {
    let of_name = |ty: &&naga::Type| ty.name.as_deref() == Some(name);
    let ty = module.types.iter().map(|(_, ty)| ty).find(of_name)?;
    let TypeInner::Struct { members, span } = &ty.inner else { return None };
    let field = |m: &naga::StructMember| (m.name.clone().unwrap(), m.offset as usize);
    // An array of words does not fit uniforms, so each word of a padding has a name.
    let more_padding = |field: &(String, usize)| field.0.starts_with("padding_");
    let found = members.iter().map(field).filter(|field| !more_padding(field));
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
