//! Which graphics adapters there are, and which would be used.

use std::path::Path;

use super::device::Device;
use super::error::DeviceError;

/// What computes, as the user asks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BackendChoice {
    /// A hardware adapter where there is one, else the processor.
    #[default]
    Auto,
    /// The processor.
    Cpu,
    /// Any graphics adapter, hardware before software.
    Gpu,
}

/// What an adapter is; the first are preferred.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A card with memory of its own.
    Discrete,
    /// Part of the processor.
    Integrated,
    /// Lent by a host.
    Virtual,
    /// Unknown hardware.
    Other,
    /// A program that acts as one, for tests: slower than painting on the
    /// processor.
    Software,
}

impl Kind {
    /// For people.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Discrete => "discrete",
            Self::Integrated => "integrated",
            Self::Virtual => "virtual",
            Self::Other => "other",
            Self::Software => "software",
        }
    }
}

/// What limits a computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// The largest buffer that a kernel may use, in bytes.
    pub binding_bytes: u64,
    /// Groups that one dispatch may have in each direction.
    pub groups: u32,
    /// Storage buffers that one kernel may use.
    pub storage_buffers: u32,
    /// Invocations in a group.
    pub invocations: u32,
}

/// A graphics adapter of this machine.
#[derive(Debug, Clone)]
pub struct Adapter {
    /// As the driver names it.
    pub name: String,
    /// The interface it is reached by: `vulkan`.
    pub backend: String,
    /// The driver and its version.
    pub driver: String,
    /// What it is.
    pub kind: Kind,
    /// Its limits.
    pub limits: Limits,
    /// Why it cannot be used, if so.
    pub unfit: Option<String>,
    pub(super) inner: wgpu::Adapter,
}

impl Adapter {
    fn new(inner: wgpu::Adapter) -> Self {
        let (info, found) = (inner.get_info(), inner.limits());
        let limits = Limits {
            binding_bytes: found.max_storage_buffer_binding_size.min(found.max_buffer_size),
            groups: found.max_compute_workgroups_per_dimension,
            storage_buffers: found.max_storage_buffers_per_shader_stage,
            invocations: found.max_compute_invocations_per_workgroup,
        };
        let flags = inner.get_downlevel_capabilities().flags;
        Self {
            unfit: unfit(limits, flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS)),
            name: info.name,
            backend: info.backend.to_string(),
            driver: [info.driver, info.driver_info].join(" ").trim().to_owned(),
            kind: match info.device_type {
                wgpu::DeviceType::DiscreteGpu => Kind::Discrete,
                wgpu::DeviceType::IntegratedGpu => Kind::Integrated,
                wgpu::DeviceType::VirtualGpu => Kind::Virtual,
                wgpu::DeviceType::Other => Kind::Other,
                wgpu::DeviceType::Cpu => Kind::Software,
            },
            limits,
            inner,
        }
    }

    /// Whether it is hardware that kernels run on.
    #[must_use]
    pub fn is_hardware(&self) -> bool {
        self.kind != Kind::Software
    }
}

fn unfit(limits: Limits, computes: bool) -> Option<String> {
    let wanted = [
        ("storage buffers a kernel", limits.storage_buffers, 8),
        ("invocations a group", limits.invocations, 64),
        ("groups a dispatch", limits.groups, 65535),
    ];
    if !computes {
        return Some("it has no compute shaders".to_owned());
    }
    let lacking = wanted.into_iter().find(|(_, found, least)| found < least)?;
    Some(format!("{} {} where {} are needed", lacking.1, lacking.0, lacking.2))
}

/// Every adapter of this machine, the one to be used first. Empty where no
/// driver is installed.
#[must_use]
pub fn adapters() -> Vec<Adapter> {
    // Never OpenGL, which another crate of the same program may have switched on:
    // nothing was tried there.
    let backends = wgpu::Instance::enabled_backend_features() & wgpu::Backends::PRIMARY;
    if backends.is_empty() {
        return Vec::new();
    }
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        flags: wgpu::InstanceFlags::empty(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let found = pollster::block_on(instance.enumerate_adapters(backends));
    let mut found: Vec<_> = found.into_iter().map(Adapter::new).collect();
    found.sort_by_key(|adapter| (adapter.unfit.is_some(), adapter.kind));
    found
}

/// The adapter that `choice` would use, of [`adapters`]; none for the processor.
#[must_use]
pub fn best(adapters: &[Adapter], choice: BackendChoice) -> Option<&Adapter> {
    let fits = |adapter: &&Adapter| {
        adapter.unfit.is_none()
            && match choice {
                BackendChoice::Auto => adapter.is_hardware(),
                BackendChoice::Cpu => false,
                BackendChoice::Gpu => true,
            }
    };
    adapters.iter().find(fits)
}

/// Whether the system shows a graphics device at all. Linux has a node for each;
/// without one no driver is loaded, as some print to the terminal.
fn hardware_is_possible() -> bool {
    const NODES: [&str; 5] = ["/dev/dri", "/dev/nvidiactl", "/dev/dxg", "/dev/kfd", "/dev/mali0"];
    !cfg!(target_os = "linux") || NODES.iter().any(|node| Path::new(node).exists())
}

/// The device to paint on; none for the processor.
///
/// # Errors
/// For [`BackendChoice::Gpu`]: [`DeviceError::NoAdapter`] where there is none, and
/// the driver's error where it does not open. `Auto` then takes the processor.
pub fn choose(choice: BackendChoice) -> Result<Option<Device>, DeviceError> {
    let skipped = match choice {
        BackendChoice::Auto => !hardware_is_possible(),
        BackendChoice::Cpu => true,
        BackendChoice::Gpu => false,
    };
    if skipped {
        return Ok(None);
    }
    let adapters = adapters();
    let opened = best(&adapters, choice).map(Device::open).transpose();
    match (choice, opened) {
        (BackendChoice::Gpu, Ok(None)) => {
            let unfit = adapters.first().and_then(|adapter| adapter.unfit.clone());
            let reason = unfit.unwrap_or_else(|| "no driver offers one".to_owned());
            Err(DeviceError::NoAdapter { reason })
        }
        (BackendChoice::Gpu, opened) => opened,
        (_, opened) => Ok(opened.ok().flatten()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_adapter_below_the_base_profile_is_unfit() {
        let enough =
            Limits { binding_bytes: 1 << 27, groups: 65535, storage_buffers: 8, invocations: 256 };
        assert_eq!(unfit(enough, true), None);
        assert!(unfit(enough, false).is_some());
        let few = Limits { storage_buffers: 4, ..enough };
        let reason = "4 storage buffers a kernel where 8 are needed";
        assert_eq!(unfit(few, true).as_deref(), Some(reason));
    }

    #[test]
    fn the_processor_needs_no_adapter() {
        assert!(matches!(choose(BackendChoice::Cpu), Ok(None)));
    }
}
