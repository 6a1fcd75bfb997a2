//! What is said without being asked: messages, lost sessions, work under way.

use std::time::{Duration, Instant, SystemTime};

use eframe::egui::{
    Align, Align2, Area, Context, Frame, Id, Layout, Order, ProgressBar, RichText, Spinner, Ui,
    vec2,
};

use super::age::ago;
use super::state::Files;
use super::work::WorkKind;
use session::Command;
use session::FileFailure;

/// How long a message that needs no answer stays.
const STAYS: Duration = Duration::from_secs(5);

/// How long work goes on before it is shown.
const SOON: Duration = Duration::from_millis(300);

/// Width of a message, and of its buttons, in points.
const WIDTH: f32 = 480.0;
const BUTTONS: f32 = 140.0;

/// The most messages shown at a time.
const MOST: usize = 4;

/// Something said.
#[derive(Debug, Clone)]
pub(super) struct Notice {
    what: String,
    hint: Option<String>,
    /// When it goes by itself.
    until: Option<Instant>,
}

impl Notice {
    /// Goes by itself.
    pub(super) fn said(what: String) -> Self {
        let what = capital(&what);
        Self { what, hint: None, until: Some(Instant::now() + STAYS) }
    }

    /// Stays until it is closed.
    pub(super) fn failed(failure: FileFailure) -> Self {
        Self { what: capital(&failure.what), hint: failure.hint, until: None }
    }
}

/// An answer to a notice.
enum Reply {
    Recover(usize),
    Discard(usize),
    Close(usize),
    Cancel(usize),
    CancelReplay,
}

impl Files {
    /// Shows what is said, in a corner over everything.
    pub(super) fn show_notices(&mut self, ctx: &Context) {
        let now = Instant::now();
        self.notices.retain(|notice| notice.until.is_none_or(|until| until > now));
        if let Some(next) = self.notices.iter().filter_map(|notice| notice.until).min() {
            ctx.request_repaint_after(next - now);
        }
        let excess = self.notices.len().saturating_sub(MOST);
        self.notices.drain(..excess);
        let mut reply = None;
        Area::new(Id::unique("file notices"))
            .order(Order::Foreground)
            .anchor(Align2::CENTER_TOP, vec2(0.0, 44.0))
            .show(ctx, |ui| {
                self.show_lost(ui, &mut reply);
                self.show_work(ui, &mut reply);
                for (index, notice) in self.notices.iter().enumerate() {
                    let words = |ui: &mut Ui| {
                        ui.label(&notice.what);
                        if let Some(hint) = &notice.hint {
                            ui.label(RichText::new(hint).weak());
                        }
                    };
                    card(ui, words, |ui| {
                        if notice.until.is_some() {
                            return;
                        }
                        if ui.button("OK").on_hover_text("Close this message").clicked() {
                            reply = Some(Reply::Close(index));
                        }
                    });
                }
            });
        match reply {
            Some(Reply::Recover(index)) => {
                let folder = self.lost[index].folder().to_owned();
                self.recover(&folder);
            }
            Some(Reply::Discard(index)) => self.lost.remove(index).discard(),
            Some(Reply::Close(index)) => {
                self.notices.remove(index);
            }
            Some(Reply::Cancel(index)) => self.works[index].job.cancel(),
            Some(Reply::CancelReplay) => self.commands.push(Command::Cancel),
            None => {}
        }
    }

    /// Paintings that were not saved when a program ended.
    fn show_lost(&self, ui: &mut Ui, reply: &mut Option<Reply>) {
        for (index, lost) in self.lost.iter().enumerate() {
            let then = SystemTime::UNIX_EPOCH + Duration::from_secs(lost.meta.seconds);
            let when = ago(then, SystemTime::now());
            let words = |ui: &mut Ui| {
                ui.label("A painting was not saved");
                let told = format!("{}, kept {when}", lost.meta.title);
                ui.label(RichText::new(told).weak());
            };
            card(ui, words, |ui| {
                let discard = ui.button("Discard");
                if discard.on_hover_text("Throws the copy away for good").clicked() {
                    *reply = Some(Reply::Discard(index));
                }
                let recover = ui.button("Recover");
                if recover.on_hover_text("Takes the painting up as it was kept").clicked() {
                    *reply = Some(Reply::Recover(index));
                }
            });
        }
    }

    /// Work that the painter waits for.
    fn show_work(&self, ui: &mut Ui, reply: &mut Option<Reply>) {
        for (index, work) in self.works.iter().enumerate() {
            if !matches!(work.kind, WorkKind::Shown | WorkKind::Saving) {
                continue;
            }
            ui.ctx().request_repaint_after(Duration::from_millis(100));
            // What is done at once would only flicker.
            if work.began.elapsed() < SOON {
                continue;
            }
            let words = |ui: &mut Ui| bar(ui, work.job.label(), work.job.share());
            card(ui, words, |ui| {
                let cancel = ui.button("Cancel");
                if cancel.on_hover_text("Gives it up; no file is left half written").clicked() {
                    *reply = Some(Reply::Cancel(index));
                }
            });
        }
        if let Some((done, of)) = self.replay {
            let share = done as f32 / of.max(1) as f32;
            let words =
                |ui: &mut Ui| bar(ui, &format!("playing, action {done} of {of}"), Some(share));
            card(ui, words, |ui| {
                if ui.button("Stop").on_hover_text("Ends the recording where it is").clicked() {
                    *reply = Some(Reply::CancelReplay);
                }
            });
        }
    }
}

/// `text` with a capital.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

fn bar(ui: &mut Ui, label: &str, share: Option<f32>) {
    ui.label(label);
    match share {
        Some(share) => ui.add(ProgressBar::new(share).desired_height(6.0)),
        None => ui.add(Spinner::new()),
    };
}

/// A small sheet of paper: words, and buttons at its right.
fn card(ui: &mut Ui, words: impl FnOnce(&mut Ui), buttons: impl FnOnce(&mut Ui)) {
    Frame::popup(ui.style()).show(ui, |ui| {
        ui.set_width(WIDTH);
        ui.horizontal(|ui| {
            ui.vertical(|ui| {
                ui.set_width(WIDTH - BUTTONS);
                words(ui);
            });
            ui.with_layout(Layout::right_to_left(Align::Center), buttons);
        });
    });
}
