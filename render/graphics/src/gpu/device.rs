//! An open device: its buffers, and how it tells that it cannot.

use std::collections::{BTreeMap, VecDeque};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::adapter::Adapter;
use super::drawing::RasterPipeline;
use super::error::DeviceError;
use super::pipeline::Pipeline;
use super::transfer::Rows;

/// Submissions that may wait on the device; a further one waits here.
const IN_FLIGHT: usize = 3;

/// How many buffers were made.
static MADE: AtomicU64 = AtomicU64::new(0);

/// Memory on the device. Clones are the same memory.
#[derive(Debug, Clone)]
pub struct Buffer {
    pub(super) inner: wgpu::Buffer,
    /// Its number among all that were made.
    pub(super) number: u64,
}

/// What the driver reported outside of any call.
#[derive(Debug, Default)]
struct Reported {
    lost: Option<String>,
    refused: Option<String>,
}

/// An open device. What it computes is asked for by submissions, one after the
/// other; errors of one may come back with a later call.
#[derive(Debug)]
pub struct Device {
    adapter: Adapter,
    pub(super) inner: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    reported: Arc<Mutex<Reported>>,
    pub(super) pipelines: BTreeMap<&'static str, Pipeline>,
    /// By shader, and whether only fronts are drawn.
    pub(super) raster_pipelines: BTreeMap<(&'static str, bool), RasterPipeline>,
    pub(super) parameters: Option<Buffer>,
    pub(super) batch: Option<Buffer>,
    in_flight: VecDeque<wgpu::SubmissionIndex>,
}

impl Device {
    /// Opens `adapter`, with all that it lends to buffers.
    ///
    /// # Errors
    /// [`DeviceError::NoAdapter`] if it is unfit or the driver does not open it.
    pub fn open(adapter: &Adapter) -> Result<Self, DeviceError> {
        if let Some(reason) = &adapter.unfit {
            return Err(DeviceError::NoAdapter { reason: format!("{}: {reason}", adapter.name) });
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
        let (inner, queue) = opened.map_err(|error| DeviceError::NoAdapter {
            reason: format!("{}: {error}", adapter.name),
        })?;
        let reported = Arc::new(Mutex::new(Reported::default()));
        let (for_loss, for_errors) = (Arc::clone(&reported), Arc::clone(&reported));
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
            parameters: None,
            batch: None,
            in_flight: VecDeque::new(),
        })
    }

    /// The adapter that it is of.
    #[must_use]
    pub fn adapter(&self) -> &Adapter {
        &self.adapter
    }

    /// Gives the device back to the driver; every call after it is told that
    /// the device was lost.
    pub fn close(&self) {
        self.inner.destroy();
        self.reported().lost.get_or_insert("it was closed".to_owned());
    }

    fn reported(&self) -> std::sync::MutexGuard<'_, Reported> {
        self.reported.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What the driver has reported since the last call.
    pub(super) fn check(&self, what: &str) -> Result<(), DeviceError> {
        let mut reported = self.reported();
        if let Some(reason) = reported.lost.clone() {
            return Err(DeviceError::Lost { reason });
        }
        match reported.refused.take() {
            Some(reason) => Err(DeviceError::Refused { what: what.to_owned(), reason }),
            None => Ok(()),
        }
    }

    /// Whether `bytes` fit one buffer.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] if they do not.
    pub fn check_size(&self, what: &'static str, bytes: u64) -> Result<(), DeviceError> {
        let limit = self.adapter.limits.binding_bytes;
        if bytes > limit {
            return Err(DeviceError::TooLarge { what, bytes, limit });
        }
        Ok(())
    }

    /// A buffer of `bytes` zeros for `what`.
    ///
    /// # Errors
    /// [`DeviceError::TooLarge`] beyond the adapter's limit,
    /// [`DeviceError::OutOfMemory`] if it has no more.
    pub fn buffer(&self, what: &'static str, bytes: u64) -> Result<Buffer, DeviceError> {
        self.check_size(what, bytes)?;
        let usage = wgpu::BufferUsages::STORAGE
            | wgpu::BufferUsages::UNIFORM
            | wgpu::BufferUsages::COPY_SRC
            | wgpu::BufferUsages::COPY_DST;
        self.allocate(what, bytes, usage)
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
        Ok(Buffer { inner, number: MADE.fetch_add(1, Ordering::Relaxed) })
    }

    /// A buffer of `values`.
    ///
    /// # Errors
    /// As [`Device::buffer`], and [`DeviceError::Lost`].
    pub fn buffer_of<T: bytemuck::Pod>(
        &mut self,
        what: &'static str,
        values: &[T],
    ) -> Result<Buffer, DeviceError> {
        let buffer = self.buffer(what, size_of_val(values) as u64)?;
        self.write(&buffer, Rows::start(values.len()), values)?;
        Ok(buffer)
    }

    /// Waits until a submission is done.
    pub(super) fn wait(&self, index: wgpu::SubmissionIndex) -> Result<(), DeviceError> {
        self.poll(wgpu::PollType::Wait { submission_index: Some(index), timeout: None })
    }

    /// Hands finished memory back. wgpu panics where a device is lost during a
    /// wait; that is caught here.
    fn poll(&self, how: wgpu::PollType) -> Result<(), DeviceError> {
        self.check("a submission")?;
        let polled = catch_unwind(AssertUnwindSafe(|| self.inner.poll(how)));
        if !matches!(polled, Ok(Ok(_))) {
            self.reported().lost.get_or_insert("it stopped answering".to_owned());
        }
        self.check("a submission")
    }

    /// Follows a submission, so that only a few wait on the device.
    pub(super) fn follow(&mut self, index: wgpu::SubmissionIndex) -> Result<(), DeviceError> {
        self.in_flight.push_back(index);
        match self.in_flight.len() > IN_FLIGHT {
            true => self.in_flight.pop_front().map_or(Ok(()), |oldest| self.wait(oldest)),
            false => self.poll(wgpu::PollType::Poll),
        }
    }

    /// Waits until all that was submitted is done.
    ///
    /// # Errors
    /// [`DeviceError::Lost`], or what the driver refused.
    pub fn finish(&mut self) -> Result<(), DeviceError> {
        let last = self.in_flight.pop_back();
        self.in_flight.clear();
        match last {
            Some(last) => self.wait(last),
            None => self.check("a submission"),
        }
    }
}

/// An error of the driver in one line.
pub(super) fn one_line(error: &wgpu::Error) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}
