//! Shows messages, lost sessions and running jobs over the window.

use web_time::{Duration, Instant, SystemTime};

use eframe::egui::{
    Align, Align2, Area, Context, Frame, Id, Layout, Order, ProgressBar, RichText, Spinner, Ui,
    vec2,
};

use super::age::ago;
use super::state::Files;
use super::work::JobKind;
use crate::language::{tr, tr_format};
use session::{Command, LostSession};

/// A job is shown after it has run for this time; a shorter one would only flicker.
const JOB_SHOWN_AFTER: Duration = Duration::from_millis(300);

/// Width of a message, in points.
const WIDTH: f32 = 480.0;
/// Width of the buttons of a message, in points.
const BUTTONS_WIDTH: f32 = 140.0;

/// Maximum number of messages shown at a time.
const MAX_NOTICES: usize = 4;

/// Bottom of the messages in the last frame, in points; `None` without messages.
pub(crate) fn bottom_of_notices(ctx: &Context) -> Option<f32> {
    let shown = ctx.memory(|memory| memory.area_rect(area_id()))?;
    (shown.height() > 1.0).then_some(shown.bottom())
}

fn area_id() -> Id {
    Id::unique("file notices")
}

/// A button that was clicked, with the index of the session, notice or job.
enum Clicked {
    Recover(usize),
    Discard(usize),
    RecoverScene(usize),
    DiscardScene(usize),
    CloseNotice(usize),
    CancelJob(usize),
    CancelReplay,
}

impl Files {
    /// Shows all messages at the top of the window, above everything else.
    pub(super) fn show_notices(&mut self, ctx: &Context) {
        let now = Instant::now();
        self.notices.retain(|notice| notice.until.is_none_or(|until| until > now));
        if let Some(next) = self.notices.iter().filter_map(|notice| notice.until).min() {
            ctx.request_repaint_after(next - now);
        }
        let excess = self.notices.len().saturating_sub(MAX_NOTICES);
        self.notices.drain(..excess);
        let mut clicked = None;
        Area::new(area_id())
            .order(Order::Foreground)
            .anchor(Align2::CENTER_TOP, vec2(0.0, 44.0))
            .show(ctx, |ui| {
                self.show_lost(ui, &mut clicked);
                self.show_jobs(ui, &mut clicked);
                for (index, notice) in self.notices.iter().enumerate() {
                    let words = |ui: &mut Ui| {
                        ui.label(&notice.text);
                        if let Some(hint) = &notice.hint {
                            ui.label(RichText::new(hint).weak());
                        }
                    };
                    card(ui, words, |ui| {
                        if notice.until.is_some() {
                            return;
                        }
                        if ui.button("OK").on_hover_text(tr("Close this message")).clicked() {
                            clicked = Some(Clicked::CloseNotice(index));
                        }
                    });
                }
            });
        match clicked {
            Some(Clicked::Recover(index)) => {
                let folder = self.lost_sessions[index].folder().to_owned();
                self.recover(&folder);
            }
            Some(Clicked::Discard(index)) => self.lost_sessions.remove(index).discard(),
            Some(Clicked::RecoverScene(index)) => self.recover_scene(index),
            Some(Clicked::DiscardScene(index)) => self.scenes.lost.remove(index).discard(),
            Some(Clicked::CloseNotice(index)) => {
                self.notices.remove(index);
            }
            Some(Clicked::CancelJob(index)) => self.jobs[index].job.cancel(),
            Some(Clicked::CancelReplay) => self.commands.push(Command::Cancel),
            None => {}
        }
    }

    /// Shows the sessions of programs that ended without saving.
    fn show_lost(&self, ui: &mut Ui, clicked: &mut Option<Clicked>) {
        for (index, lost) in self.lost_sessions.iter().enumerate() {
            let answer = lost_card(ui, lost, tr("painting"));
            *clicked = match answer {
                Some(true) => Some(Clicked::Recover(index)),
                Some(false) => Some(Clicked::Discard(index)),
                None => continue,
            };
        }
        for (index, lost) in self.scenes.lost.iter().enumerate() {
            let answer = lost_card(ui, lost, tr("scene"));
            *clicked = match answer {
                Some(true) => Some(Clicked::RecoverScene(index)),
                Some(false) => Some(Clicked::DiscardScene(index)),
                None => continue,
            };
        }
    }

    /// Shows the jobs that the painter waits for.
    fn show_jobs(&self, ui: &mut Ui, clicked: &mut Option<Clicked>) {
        for (index, job) in self.jobs.iter().enumerate() {
            if !matches!(job.kind, JobKind::Shown | JobKind::Saving) {
                continue;
            }
            ui.ctx().request_repaint_after(Duration::from_millis(100));
            if job.began.elapsed() < JOB_SHOWN_AFTER {
                continue;
            }
            card(
                ui,
                |ui: &mut Ui| bar(ui, job.job.label(), job.job.fraction()),
                |ui| {
                    let cancel = ui.button(tr("Cancel"));
                    if cancel
                        .on_hover_text(tr("Cancels it; no file is left half written"))
                        .clicked()
                    {
                        *clicked = Some(Clicked::CancelJob(index));
                    }
                },
            );
        }
        if let Some((done, of)) = self.replay {
            let fraction = done as f32 / of.max(1) as f32;
            let words = |ui: &mut Ui| {
                bar(ui, &tr_format!("playing, action {done} of {of}", done, of), Some(fraction));
            };
            card(ui, words, |ui| {
                if ui.button(tr("Stop")).on_hover_text(tr("Ends the recording here")).clicked() {
                    *clicked = Some(Clicked::CancelReplay);
                }
            });
        }
    }
}

/// Offers to recover a lost `kind` of work. Returns whether it is to be recovered or discarded.
fn lost_card(ui: &mut Ui, lost: &LostSession, kind: &str) -> Option<bool> {
    let then = SystemTime::UNIX_EPOCH + Duration::from_secs(lost.meta.seconds);
    let when = ago(then, SystemTime::now());
    let words = |ui: &mut Ui| {
        ui.label(tr_format!("A {kind} was not saved", kind));
        let details = tr_format!("{title}, autosaved {when}", title = lost.meta.title, when);
        ui.label(RichText::new(details).weak());
    };
    let mut answer = None;
    card(ui, words, |ui| {
        if ui.button(tr("Discard")).on_hover_text(tr("Deletes the autosaved copy")).clicked() {
            answer = Some(false);
        }
        let tip = tr_format!("Opens the {kind} as it was autosaved", kind);
        if ui.button(tr("Recover")).on_hover_text(tip).clicked() {
            answer = Some(true);
        }
    });
    answer
}

/// A label over a progress bar, or over a spinner if the progress is not known.
fn bar(ui: &mut Ui, label: &str, fraction: Option<f32>) {
    ui.label(label);
    match fraction {
        Some(fraction) => ui.add(ProgressBar::new(fraction).desired_height(6.0)),
        None => ui.add(Spinner::new()),
    };
}

/// A framed message with buttons at its right.
fn card(ui: &mut Ui, words: impl FnOnce(&mut Ui), buttons: impl FnOnce(&mut Ui)) {
    Frame::popup(ui.style()).show(ui, |ui| {
        ui.set_width(WIDTH);
        ui.horizontal(|ui| {
            ui.vertical(|ui| {
                ui.set_width(WIDTH - BUTTONS_WIDTH);
                words(ui);
            });
            ui.with_layout(Layout::right_to_left(Align::Center), buttons);
        });
    });
}
