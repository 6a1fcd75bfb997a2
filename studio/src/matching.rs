//! Recipes for a colour, searched beside the window.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use pigment::library::PigmentLibrary;
use pigment::matching::{MatchError, MatchRequest, Recipe, Target, Watch, recipes_watched};

/// What is searched for.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// The pigments.
    pub library: Arc<PigmentLibrary>,
    /// The colour wanted.
    pub target: Target,
    /// The limits of the recipes.
    pub request: MatchRequest,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// What had been asked.
    pub question: Question,
    /// The best recipes, the best first.
    pub recipes: Result<Vec<Recipe>, MatchError>,
}

/// One search at a time, on a thread of its own. A new question takes the place of
/// an older one, whose answer is never heard.
#[derive(Debug, Default)]
pub struct Matcher {
    running: Option<Running>,
    answer: Option<Answer>,
    died: bool,
}

#[derive(Debug)]
struct Running {
    watch: Arc<Watch>,
    told: Receiver<Answer>,
}

impl Matcher {
    /// Begins a search. `wake` is called from its thread when it ends.
    pub fn ask(&mut self, question: Question, wake: impl FnOnce() + Send + 'static) {
        self.cancel();
        self.died = false;
        let watch = Arc::new(Watch::default());
        let (tell, told) = channel();
        self.running = Some(Running { watch: Arc::clone(&watch), told });
        std::thread::spawn(move || {
            let Question { library, target, request } = &question;
            let recipes = recipes_watched(library, target, request, &watch).transpose();
            if let Some(recipes) = recipes {
                let _ = tell.send(Answer { question, recipes });
            }
            drop(tell);
            wake();
        });
    }

    /// Ends the search. What was found before stays.
    pub fn cancel(&mut self) {
        if let Some(running) = self.running.take() {
            running.watch.stop();
        }
    }

    /// Takes in what the thread told since the last call.
    pub fn update(&mut self) {
        let Some(running) = &self.running else { return };
        match running.told.try_recv() {
            Ok(answer) => {
                self.answer = Some(answer);
                self.running = None;
            }
            Err(TryRecvError::Disconnected) => {
                self.died = true;
                self.running = None;
            }
            Err(TryRecvError::Empty) => {}
        }
    }

    /// How far a search is, 0..1; `None` if none runs.
    #[must_use]
    pub fn progress(&self) -> Option<f64> {
        self.running.as_ref().map(|running| running.watch.share())
    }

    /// What the last search that ended found.
    #[must_use]
    pub fn answer(&self) -> Option<&Answer> {
        self.answer.as_ref()
    }

    /// Whether the last search ended without an answer, by a fault of ours.
    #[must_use]
    pub fn died(&self) -> bool {
        self.died
    }
}

impl Drop for Matcher {
    fn drop(&mut self) {
        self.cancel();
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use pigment::evaluate::Viewing;
    use pigment::matching::{FilmKind, Sight, recipes};
    use spectra::color::Lab;

    use super::*;
    use pigment::library::PigmentLibrary;

    fn question(lightness: f64, at_most: usize) -> Question {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let sights = vec![Sight { viewing: Viewing::default(), weight: 1.0 }];
        let target = Target::from_lab("wanted", Lab { lightness, a: 4.0, b: 9.0 }, &sights);
        let request =
            MatchRequest { at_most, ..MatchRequest::new(&library, sights, FilmKind::Hiding) };
        Question { library, target, request }
    }

    /// A question that takes many seconds.
    fn long_question() -> Question {
        let mut asked = question(60.0, 8);
        let library = Arc::make_mut(&mut asked.library);
        for copy in 0..2 {
            let mut copies = PigmentLibrary::van_gogh_oils().pigments;
            for pigment in &mut copies {
                pigment.name.push_str(&format!(" {copy}"));
            }
            library.pigments.extend(copies);
        }
        asked.request.allowed = (0..library.pigments.len()).collect();
        asked
    }

    fn wait(matcher: &mut Matcher) {
        let patience = Instant::now() + Duration::from_secs(120);
        while matcher.progress().is_some() {
            assert!(Instant::now() < patience, "the search does not end");
            std::thread::sleep(Duration::from_millis(2));
            matcher.update();
        }
    }

    #[test]
    fn what_is_found_is_what_calibrate_finds() {
        let asked = question(50.0, 2);
        let mut matcher = Matcher::default();
        let (woken, wakes) = channel();
        matcher.ask(asked.clone(), move || woken.send(()).unwrap());
        wait(&mut matcher);
        wakes.recv_timeout(Duration::from_secs(60)).unwrap();
        let answer = matcher.answer().unwrap();
        assert_eq!(answer.question, asked);
        let wanted = recipes(&asked.library, &asked.target, &asked.request).unwrap();
        assert_eq!(answer.recipes.as_ref().unwrap(), &wanted);
        assert!(!wanted.is_empty(), "oils make a brown");
    }

    #[test]
    fn an_older_question_never_answers_after_a_newer_one() {
        let (old, new) = (long_question(), question(30.0, 1));
        let mut matcher = Matcher::default();
        let (ended, ends) = channel();
        let of_old = ended.clone();
        matcher.ask(old, move || of_old.send("old").unwrap());
        let watch = Arc::clone(&matcher.running.as_ref().unwrap().watch);
        matcher.ask(new.clone(), move || ended.send("new").unwrap());
        assert!(watch.stopped(), "the older search was told to stop");
        // Both threads end soon, whichever is the first.
        for _ in 0..2 {
            ends.recv_timeout(Duration::from_secs(20)).unwrap();
        }
        wait(&mut matcher);
        assert_eq!(matcher.answer().unwrap().question, new);
    }

    #[test]
    fn a_cancelled_search_ends_and_what_was_found_stays() {
        let mut matcher = Matcher::default();
        let first = question(40.0, 1);
        matcher.ask(first.clone(), || ());
        wait(&mut matcher);
        let (ended, ends) = channel();
        matcher.ask(long_question(), move || ended.send(()).unwrap());
        let watch = Arc::clone(&matcher.running.as_ref().unwrap().watch);
        matcher.cancel();
        assert!(watch.stopped(), "the search was told to stop");
        assert_eq!(matcher.progress(), None);
        ends.recv_timeout(Duration::from_secs(20)).expect("a search that is stopped ends soon");
        matcher.update();
        assert_eq!(matcher.answer().unwrap().question, first);
        assert!(!matcher.died(), "cancelled is not dead");
    }

    #[test]
    fn a_question_that_cannot_be_met_is_answered_with_the_reason() {
        let mut asked = question(50.0, 2);
        asked.request.allowed.clear();
        let mut matcher = Matcher::default();
        matcher.ask(asked, || ());
        wait(&mut matcher);
        let reason = matcher.answer().unwrap().recipes.as_ref().unwrap_err();
        assert_eq!(*reason, MatchError::NoPigments);
    }
}
