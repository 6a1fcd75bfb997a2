//! A virtual X screen with simulated keyboard and pointer.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use web_time::{Duration, Instant};

use x11rb::connection::Connection;
use x11rb::protocol::xproto::{self, ConnectionExt as _, ImageFormat, InputFocus, MapState};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

/// Keysyms of keys that produce no text (keysymdef.h).
pub(crate) const RETURN: u32 = 0xff0d;
pub(crate) const CONTROL: u32 = 0xffe3;
pub(crate) const SHIFT: u32 = 0xffe1;

const PRIMARY: u8 = 1;
pub(crate) const SECONDARY: u8 = 3;

/// A running X server.
pub(crate) struct Screen {
    server: Child,
    /// Value of `DISPLAY` for programs.
    pub(crate) name: String,
    connection: RustConnection,
    root: u32,
    size: (u16, u16),
    /// For each key code its keysyms without and with shift.
    keys: Vec<(u8, u32, u32)>,
}

/// Pixels of a part of the screen.
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Pixels {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Red, green and blue bytes, row by row.
    pub(crate) rows: Vec<[u8; 3]>,
}

impl Pixels {
    /// Pixel at a column and row.
    pub(crate) fn at(&self, x: usize, y: usize) -> [u8; 3] {
        self.rows[y * self.width + x]
    }

    /// Number of pixels that differ from another picture of equal size.
    pub(crate) fn differing(&self, other: &Self) -> usize {
        assert_eq!((self.width, self.height), (other.width, other.height), "the sizes differ");
        self.rows.iter().zip(&other.rows).filter(|(a, b)| a != b).count()
    }

    /// Saves the picture for you to inspect and returns its path.
    pub(crate) fn keep(&self, name: &str) -> String {
        let thread = std::thread::current();
        let test = thread.name().and_then(|name| name.split("::").next()).unwrap_or("window");
        let path = format!("{}/window-{test}-{name}.png", env!("CARGO_TARGET_TMPDIR"));
        self.save(Path::new(&path));
        path
    }

    /// Saves the picture as a PNG.
    pub(crate) fn save(&self, path: &Path) {
        let bytes: Vec<u8> = self.rows.iter().flatten().copied().collect();
        let width = self.width as u32;
        let height = self.height as u32;
        let saved = image::save_buffer(path, &bytes, width, height, image::ColorType::Rgb8);
        saved.expect("a picture is written");
    }
}

impl Screen {
    /// Starts a screen of this size in pixels; `None` without Xvfb.
    pub(crate) fn start(width: u16, height: u16) -> Option<Self> {
        let size = format!("{width}x{height}x24");
        let mut command = Command::new("Xvfb");
        command.args(["-displayfd", "1", "-screen", "0", &size, "-nolisten", "tcp"]);
        let spawned = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
        let mut server = spawned.ok()?;
        let mut number = String::new();
        let output = server.stdout.take().expect("the output is piped");
        BufReader::new(output)
            .read_line(&mut number)
            .expect("the server prints its display number");
        let name = format!(":{}", number.trim());
        let (connection, screen) = x11rb::connect(Some(&name)).expect("the server answers");
        connection.xtest_get_version(2, 2).unwrap().reply().expect("the server has XTEST");
        let setup = connection.setup();
        let root = setup.roots[screen].root;
        let first = setup.min_keycode;
        let last = setup.max_keycode;
        let map =
            connection.get_keyboard_mapping(first, last - first + 1).unwrap().reply().unwrap();
        let of_each = usize::from(map.keysyms_per_keycode);
        let keys = (first..=last)
            .zip(map.keysyms.chunks(of_each))
            .map(|(code, writes)| (code, writes[0], writes.get(1).copied().unwrap_or_default()))
            .collect();
        Some(Self { server, name, connection, root, size: (width, height), keys })
    }

    /// Waits for a program's window and gives it the keyboard focus, because there is no window
    /// manager.
    pub(crate) fn focus_window(&self) {
        let window = until("a window is shown", || {
            let tree = self.connection.query_tree(self.root).unwrap().reply().unwrap();
            tree.children.into_iter().find(|&window| {
                let shown = self.connection.get_window_attributes(window).unwrap().reply();
                let size = self.connection.get_geometry(window).unwrap().reply();
                shown.is_ok_and(|shown| shown.map_state == MapState::VIEWABLE)
                    && size.is_ok_and(|size| size.width > 100)
            })
        });
        self.connection
            .set_input_focus(InputFocus::PARENT, window, x11rb::CURRENT_TIME)
            .unwrap()
            .check()
            .expect("the window takes the keyboard");
    }

    /// Presses and releases the key that writes `writes`, while the keys `held` are down. All are
    /// keysyms.
    pub(crate) fn key(&self, writes: u32, held: &[u32]) {
        let (code, shifted) = self.code(writes);
        let mut held = held.to_vec();
        if shifted && !held.contains(&SHIFT) {
            held.push(SHIFT);
        }
        let codes: Vec<u8> = held.iter().map(|&key| self.code(key).0).collect();
        codes.iter().for_each(|&code| self.fake(xproto::KEY_PRESS_EVENT, code));
        self.fake(xproto::KEY_PRESS_EVENT, code);
        self.fake(xproto::KEY_RELEASE_EVENT, code);
        codes.iter().rev().for_each(|&code| self.fake(xproto::KEY_RELEASE_EVENT, code));
        self.connection.sync().expect("the server is there");
        // The program needs a frame in which it sees key and modifiers.
        std::thread::sleep(Duration::from_millis(40));
    }

    pub(crate) fn text(&self, text: &str) {
        for letter in text.chars() {
            self.key(u32::from(letter), &[]);
        }
    }

    pub(crate) fn point(&self, (x, y): (i32, i32)) {
        let [x, y] = [x, y].map(|length| i16::try_from(length).expect("a place on a screen"));
        self.connection
            .xtest_fake_input(xproto::MOTION_NOTIFY_EVENT, 0, 0, self.root, x, y, 0)
            .unwrap();
        self.connection.sync().expect("the server is there");
    }

    pub(crate) fn button(&self, pressed: bool) {
        self.numbered_button(PRIMARY, pressed);
    }

    fn numbered_button(&self, number: u8, pressed: bool) {
        let kind = if pressed { xproto::BUTTON_PRESS_EVENT } else { xproto::BUTTON_RELEASE_EVENT };
        self.fake(kind, number);
        self.connection.sync().expect("the server is there");
    }

    pub(crate) fn click(&self, at: (i32, i32)) {
        self.click_with(PRIMARY, at);
    }

    /// Clicks at a position with the button of this number.
    pub(crate) fn click_with(&self, number: u8, at: (i32, i32)) {
        self.point(at);
        std::thread::sleep(Duration::from_millis(80));
        self.numbered_button(number, true);
        std::thread::sleep(Duration::from_millis(80));
        self.numbered_button(number, false);
    }

    /// Drags along a line with 125 pointer positions per second.
    pub(crate) fn drag(&self, from: (i32, i32), to: (i32, i32), seconds: f64) {
        self.begin_drag(from, to, seconds);
        self.button(false);
    }

    /// Drags along a line and keeps the button pressed.
    pub(crate) fn begin_drag(&self, from: (i32, i32), to: (i32, i32), seconds: f64) {
        self.point(from);
        std::thread::sleep(Duration::from_millis(60));
        self.button(true);
        let steps = (seconds * 125.0).ceil().max(1.0) as i32;
        for step in 1..=steps {
            std::thread::sleep(Duration::from_millis(8));
            let x = from.0 + (to.0 - from.0) * step / steps;
            let y = from.1 + (to.1 - from.1) * step / steps;
            self.point((x, y));
        }
    }

    /// Captures columns `x` and rows `y`.
    pub(crate) fn pixels(&self, x: std::ops::Range<usize>, y: std::ops::Range<usize>) -> Pixels {
        let width = x.len();
        let height = y.len();
        assert!(x.end <= self.size.0.into() && y.end <= self.size.1.into(), "beyond the screen");
        let [left, top, across, down] = [x.start, y.start, width, height]
            .map(|length| u16::try_from(length).expect("a screen is small"));
        let image = self
            .connection
            .get_image(
                ImageFormat::Z_PIXMAP,
                self.root,
                left as i16,
                top as i16,
                across,
                down,
                u32::MAX,
            )
            .unwrap()
            .reply()
            .expect("the server returns pixels");
        // Every Xvfb on x86 and ARM has 24 bits of colour in 32, blue first.
        let rows = image.data.chunks_exact(4).map(|pixel| [pixel[2], pixel[1], pixel[0]]);
        let rows: Vec<[u8; 3]> = rows.collect();
        assert_eq!(rows.len(), width * height, "32 bits a pixel");
        Pixels { width, height, rows }
    }

    pub(crate) fn size(&self) -> (usize, usize) {
        (self.size.0.into(), self.size.1.into())
    }

    /// Moves the pointer to the status line, so that it draws no cursor on the canvas.
    pub(crate) fn aside(&self) {
        self.point((120, i32::from(self.size.1) - 8));
    }

    pub(crate) fn all(&self) -> Pixels {
        self.pixels(0..self.size.0.into(), 0..self.size.1.into())
    }

    /// Captures a part of the screen once it has not changed for two seconds.
    pub(crate) fn still(&self, x: std::ops::Range<usize>, y: std::ops::Range<usize>) -> Pixels {
        let mut last = self.pixels(x.clone(), y.clone());
        let mut since = Instant::now();
        until("the picture rests", || {
            let now = self.pixels(x.clone(), y.clone());
            if now != last {
                last = now;
                since = Instant::now();
            }
            (since.elapsed() > Duration::from_secs(2)).then(|| last.clone())
        })
    }

    fn code(&self, writes: u32) -> (u8, bool) {
        let plain = self.keys.iter().find(|key| key.1 == writes).map(|key| (key.0, false));
        plain
            .or_else(|| self.keys.iter().find(|key| key.2 == writes).map(|key| (key.0, true)))
            .unwrap_or_else(|| panic!("no key writes {writes:#x}"))
    }

    fn fake(&self, kind: u8, detail: u8) {
        self.connection.xtest_fake_input(kind, detail, 0, self.root, 0, 0, 0).unwrap();
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// Polls `found` until it returns a value, for at most two minutes.
pub(crate) fn until<T>(what: &str, mut found: impl FnMut() -> Option<T>) -> T {
    let began = Instant::now();
    loop {
        if let Some(found) = found() {
            return found;
        }
        assert!(began.elapsed() < Duration::from_secs(120), "never: {what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}
