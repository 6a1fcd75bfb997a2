//! Tablet support of a Wayland compositor.

use wayland_client::globals::{GlobalListContents, registry_queue_init};
use wayland_client::protocol::wl_registry::{Event, WlRegistry};
use wayland_client::{Connection, Dispatch, QueueHandle};

struct Globals;

impl Dispatch<WlRegistry, GlobalListContents> for Globals {
    fn event(
        _: &mut Self,
        _: &WlRegistry,
        _: Event,
        _: &GlobalListContents,
        _: &Connection,
        _: &QueueHandle<Self>,
    ) {
    }
}

/// Version of `zwp_tablet_manager_v2` that the compositor offers, queried on a separate
/// connection; `None` if it offers none.
pub(super) fn tablet_version() -> Option<u32> {
    let connection = Connection::connect_to_env().ok()?;
    let (globals, _) = registry_queue_init::<Globals>(&connection).ok()?;
    globals.contents().with_list(|list| {
        let found = list.iter().find(|global| global.interface == "zwp_tablet_manager_v2");
        found.map(|global| global.version)
    })
}
