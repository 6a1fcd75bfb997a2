//! The graphics adapters of this machine, and the ways in which a graphics device fails.

use documents::hint::Explain;

/// Your choice of what computes: the processor or a graphics adapter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BackendChoice {
    /// A hardware adapter if there is one, else the processor.
    #[default]
    Auto,
    /// The processor. This never uses a graphics adapter.
    Cpu,
    /// Any graphics adapter. This prefers hardware to software.
    Gpu,
}

/// Kinds of adapters, in order of preference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A graphics card with memory of its own.
    Discrete,
    /// Graphics hardware in the processor, which shares its memory.
    Integrated,
    /// Hardware that a virtual machine gets from its host.
    Virtual,
    /// Hardware of a kind that the driver does not state.
    Other,
    /// An emulation on the processor, e.g. lavapipe. Use this for tests only: it is slower than
    /// [`BackendChoice::Cpu`].
    Software,
}

impl Kind {
    /// The kind in lower case, for messages.
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

/// Limits of an adapter that matter to kernels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Size of the largest buffer that a kernel can bind, in bytes.
    pub binding_bytes: u64,
    /// Largest number of workgroups of a dispatch in each direction.
    pub groups: u32,
    /// Largest number of storage buffers of a kernel.
    pub storage_buffers: u32,
    /// Largest number of invocations per workgroup.
    pub invocations: u32,
}

/// A graphics adapter of this machine.
#[derive(Debug, Clone)]
pub struct Adapter {
    /// Name that the driver reports.
    pub name: String,
    /// Graphics interface through which it is used: `vulkan`.
    pub backend: String,
    /// Name and version of the driver.
    pub driver: String,
    /// Discrete, integrated, virtual, other or software.
    pub kind: Kind,
    /// Limits that kernels must stay within.
    pub limits: Limits,
    /// The reason why you cannot use it. `None` if you can.
    pub unfit: Option<String>,
    pub(super) inner: wgpu::Adapter,
}

impl Adapter {
    fn new(inner: wgpu::Adapter) -> Self {
        let info = inner.get_info();
        let found = inner.limits();
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

    /// Whether this is hardware, not an emulation on the processor.
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

/// Every adapter of this machine, in order of preference. Unfit ones come last. If no driver is
/// installed, this is empty.
#[must_use]
pub fn adapters() -> Vec<Adapter> {
    // This excludes OpenGL, which another crate of the program may have enabled. We never tested
    // kernels on it.
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

/// The adapter of `adapters` that `choice` selects. `None` means the processor.
#[must_use]
pub fn best(adapters: &[Adapter], choice: BackendChoice) -> Option<&Adapter> {
    adapters.iter().find(|adapter: &&Adapter| {
        adapter.unfit.is_none()
            && match choice {
                BackendChoice::Auto => adapter.is_hardware(),
                BackendChoice::Cpu => false,
                BackendChoice::Gpu => true,
            }
    })
}

/// A graphics device failed. You never get this from the processor.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[hint("paint on the processor: [backend=cpu]")]
#[fault(Environment)]
pub enum DeviceError {
    /// You cannot use any adapter.
    #[error("no graphics adapter: {0}")]
    NoAdapter(String),
    /// The device was lost, with all its memory.
    #[error("the graphics device was lost: {0}")]
    Lost(String),
    /// A buffer is larger than the adapter allows.
    #[error("{what} takes {bytes} bytes, the device allows {limit}")]
    TooLarge {
        /// Description of the content.
        what: &'static str,
        /// Size of the content in bytes.
        bytes: u64,
        /// Largest size of a buffer in bytes.
        limit: u64,
    },
    /// The device has too little free memory.
    #[error("{what} takes {bytes} bytes, more than the device has left")]
    OutOfMemory {
        /// Description of the content.
        what: &'static str,
        /// Size of the content in bytes.
        bytes: u64,
    },
    /// The driver rejected a shader, a buffer or a command.
    #[error("the graphics driver refuses {what}: {reason}")]
    Refused {
        /// Description of what was rejected.
        what: String,
        /// Message of the driver.
        reason: String,
    },
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
}
