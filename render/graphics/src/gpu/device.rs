//! An open device with its memory and its errors, and the choice between the processor and a
//! device.

use std::collections::{BTreeMap, VecDeque};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::adapter::{Adapter, BackendChoice, DeviceError, adapters, best};
use super::pipelines::{Pipeline, RasterPipeline, ScatterPipeline, StencilPipeline};

/// At most this many submissions are pending on the device. The next one waits for the oldest. We
/// chose few, so that memory is freed soon.
const IN_FLIGHT: usize = 3;

static NEXT_NUMBER: AtomicU64 = AtomicU64::new(0);

/// Memory on the device. Clones share this memory.
#[derive(Debug, Clone)]
pub struct Buffer {
    pub(super) inner: wgpu::Buffer,
    pub(super) number: u64,
}

/// Errors that the driver reported through its callbacks.
#[derive(Debug, Default)]
struct Reported {
    lost: Option<String>,
    refused: Option<String>,
}

/// An open device. It executes submissions in their order. You may get the error of a submission
/// from a later call.
#[derive(Debug)]
pub struct Device {
    adapter: Adapter,
    pub(super) inner: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    reported: Arc<Mutex<Reported>>,
    pub(super) pipelines: BTreeMap<&'static str, Pipeline>,
    /// Key: name of the shader, and whether back faces are culled.
    pub(super) raster_pipelines: BTreeMap<(&'static str, bool), RasterPipeline>,
    pub(super) stencil_pipelines: BTreeMap<&'static str, StencilPipeline>,
    pub(super) scatter_pipelines: BTreeMap<&'static str, ScatterPipeline>,
    pub(super) parameters: Option<Buffer>,
    pub(super) batch: Option<Buffer>,
    in_flight: VecDeque<wgpu::SubmissionIndex>,
}

impl Device {
    /// Opens `adapter`. You can allocate buffers up to the largest size that the adapter allows.
    ///
    /// # Errors
    /// [`DeviceError::NoAdapter`] if the adapter is unfit or the driver cannot open it.
    pub fn open(adapter: &Adapter) -> Result<Self, DeviceError> {
        if let Some(reason) = &adapter.unfit {
            return Err(DeviceError::NoAdapter(format!("{}: {reason}", adapter.name)));
        }
        let own = adapter.inner.limits();
        let limits = wgpu::Limits {
            max_storage_buffer_binding_size: own.max_storage_buffer_binding_size,
            max_buffer_size: own.max_buffer_size,
            max_texture_dimension_2d: own.max_texture_dimension_2d,
            ..wgpu::Limits::downlevel_defaults()
        };
        let limits = wgpu::Limits { max_storage_buffers_per_shader_stage: 8, ..limits };
        let asked = wgpu::DeviceDescriptor {
            label: Some("impasto"),
            required_limits: limits,
            ..wgpu::DeviceDescriptor::default()
        };
        let opened = pollster::block_on(adapter.inner.request_device(&asked));
        let (inner, queue) =
            opened.map_err(|error| DeviceError::NoAdapter(format!("{}: {error}", adapter.name)))?;
        let reported = Arc::new(Mutex::new(Reported::default()));
        let for_loss = Arc::clone(&reported);
        let for_errors = Arc::clone(&reported);
        inner.set_device_lost_callback(move |_, reason| {
            let mut reported = for_loss.lock().unwrap_or_else(PoisonError::into_inner);
            reported.lost.get_or_insert(reason);
        });
        inner.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            let mut reported = for_errors.lock().unwrap_or_else(PoisonError::into_inner);
            reported.refused.get_or_insert_with(|| one_line(&error));
        }));
        Ok(Self {
            adapter: adapter.clone(),
            inner,
            queue,
            reported,
            pipelines: BTreeMap::new(),
            raster_pipelines: BTreeMap::new(),
            stencil_pipelines: BTreeMap::new(),
            scatter_pipelines: BTreeMap::new(),
            parameters: None,
            batch: None,
            in_flight: VecDeque::new(),
        })
    }

    /// The adapter of this device.
    #[must_use]
    pub fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    /// Destroys the device: every later call returns [`DeviceError::Lost`].
    pub fn close(&self) {
        self.inner.destroy();
        self.reported().lost.get_or_insert("it was closed".to_owned());
    }

    fn reported(&self) -> std::sync::MutexGuard<'_, Reported> {
        self.reported.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the first error that the driver reported since the last call. `what` names the
    /// current operation.
    pub(super) fn check(&self, what: &str) -> Result<(), DeviceError> {
        let mut reported = self.reported();
        if let Some(reason) = reported.lost.clone() {
            return Err(DeviceError::Lost(reason));
        }
        match reported.refused.take() {
            Some(reason) => Err(DeviceError::Refused { what: what.to_owned(), reason }),
            None => Ok(()),
        }
    }

    /// Checks that a buffer may have `bytes`. `what` names its content in the error.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] beyond the limit of the adapter.
    pub fn check_size(&self, what: &'static str, bytes: u64) -> Result<(), DeviceError> {
        let limit = self.adapter.limits.binding_bytes;
        if bytes > limit {
            return Err(DeviceError::TooLarge { what, bytes, limit });
        }
        Ok(())
    }

    /// Allocates a buffer of `bytes` zeros. `what` names its content in errors, for example
    /// `paint`.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] beyond the limit of the adapter, [`DeviceError::OutOfMemory`] if
    /// the device has no memory left.
    pub fn buffer(&self, what: &'static str, bytes: u64) -> Result<Buffer, DeviceError> {
        self.check_size(what, bytes)?;
        let usage = wgpu::BufferUsages::STORAGE
            | wgpu::BufferUsages::UNIFORM
            | wgpu::BufferUsages::COPY_SRC
            | wgpu::BufferUsages::COPY_DST;
        self.allocate(what, bytes, usage)
    }

    /// Runs `compile`, which creates a pipeline. `what` names it in the error.
    ///
    /// # Errors
    /// [`DeviceError::Refused`] if the driver rejects the shader.
    pub(super) fn compile<T>(
        &self,
        what: impl FnOnce() -> String,
        compile: impl FnOnce(&wgpu::Device) -> T,
    ) -> Result<T, DeviceError> {
        let scopes = [wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::Internal]
            .map(|filter| self.inner.push_error_scope(filter));
        let pipeline = compile(&self.inner);
        for scope in scopes.into_iter().rev() {
            if let Some(error) = pollster::block_on(scope.pop()) {
                return Err(DeviceError::Refused { what: what(), reason: one_line(&error) });
            }
        }
        Ok(pipeline)
    }

    pub(super) fn allocate(
        &self,
        what: &'static str,
        bytes: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<Buffer, DeviceError> {
        let memory = self.inner.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let inner = self.inner.create_buffer(&wgpu::BufferDescriptor {
            label: Some(what),
            size: bytes.max(16).next_multiple_of(16),
            usage,
            mapped_at_creation: false,
        });
        if pollster::block_on(memory.pop()).is_some() {
            return Err(DeviceError::OutOfMemory { what, bytes });
        }
        self.check(what)?;
        Ok(Buffer { inner, number: NEXT_NUMBER.fetch_add(1, Ordering::Relaxed) })
    }

    pub(super) fn wait(&self, index: wgpu::SubmissionIndex) -> Result<(), DeviceError> {
        self.poll(wgpu::PollType::Wait { submission_index: Some(index), timeout: None })
    }

    /// Polls the driver, which frees memory no longer in use. wgpu panics if the device is lost
    /// during a wait. We catch this panic here.
    fn poll(&self, how: wgpu::PollType) -> Result<(), DeviceError> {
        self.check("a submission")?;
        let polled = catch_unwind(AssertUnwindSafe(|| self.inner.poll(how)));
        if !matches!(polled, Ok(Ok(_))) {
            self.reported().lost.get_or_insert("it stopped answering".to_owned());
        }
        self.check("a submission")
    }

    /// Registers a submission, and waits for an older one if too many are pending.
    pub(super) fn follow(&mut self, index: wgpu::SubmissionIndex) -> Result<(), DeviceError> {
        self.in_flight.push_back(index);
        match self.in_flight.len() > IN_FLIGHT {
            true => self.in_flight.pop_front().map_or(Ok(()), |oldest| self.wait(oldest)),
            false => self.poll(wgpu::PollType::Poll),
        }
    }

    /// Waits until all submissions have been executed.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] if the device was lost, [`DeviceError::Refused`] if the driver
    /// rejected a command.
    pub fn finish(&mut self) -> Result<(), DeviceError> {
        let last = self.in_flight.pop_back();
        self.in_flight.clear();
        match last {
            Some(last) => self.wait(last),
            None => self.check("a submission"),
        }
    }
}

/// The message of a driver error without line breaks.
pub(super) fn one_line(error: &wgpu::Error) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Whether the system may have graphics hardware. Linux has a device node for it. We load no
/// driver without this node, since some drivers print to the terminal.
fn hardware_is_possible() -> bool {
    const NODES: [&str; 5] = ["/dev/dri", "/dev/nvidiactl", "/dev/dxg", "/dev/kfd", "/dev/mali0"];
    !cfg!(target_os = "linux") || NODES.iter().any(|node| Path::new(node).exists())
}

/// Opens the device that `choice` selects. `None` means that you compute on the processor.
///
/// # Errors
/// Only for [`BackendChoice::Gpu`]: [`DeviceError::NoAdapter`] if there is no usable adapter, or
/// the driver's error if it cannot be opened. `Auto` then selects the processor.
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
            Err(DeviceError::NoAdapter(reason))
        }
        (BackendChoice::Gpu, opened) => opened,
        (_, opened) => Ok(opened.ok().flatten()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_needs_no_adapter() {
        assert!(matches!(choose(BackendChoice::Cpu), Ok(None)));
    }
}
