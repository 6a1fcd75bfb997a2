//! Search for paint recipes on a background thread.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use documents::Task;
use pigment::library::PigmentLibrary;
use pigment::matching::{MatchError, RecipeLimits, RecipeMatch, Target, recipes};
use session::thread;

/// A target colour, and the pigments and limits of the search.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchRequest {
    /// Library that the recipes may use.
    pub library: Arc<PigmentLibrary>,
    /// Colour that the recipes should match.
    pub target: Target,
    /// Allowed pigments, film, and number of recipes.
    pub limits: RecipeLimits,
}

/// A finished search.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchResult {
    /// Request that was searched.
    pub request: SearchRequest,
    /// Recipes found, best match first.
    pub recipes: Result<Vec<RecipeMatch>, MatchError>,
}

/// Runs one search at a time on its own thread. A new search cancels the previous one and discards
/// its result.
#[derive(Debug, Default)]
pub struct RecipeSearch {
    running: Option<Running>,
    result: Option<SearchResult>,
    crashed: bool,
}

#[derive(Debug)]
struct Running {
    task: Task,
    receiver: Receiver<SearchResult>,
}

impl RecipeSearch {
    /// Starts a search. Its thread calls `wake` when it ends.
    pub fn start(&mut self, request: SearchRequest, wake: impl FnOnce() + Send + 'static) {
        self.cancel();
        self.crashed = false;
        let task = Task::default();
        let (sender, receiver) = channel();
        self.running = Some(Running { task: task.clone(), receiver });
        thread::start(move || {
            let SearchRequest { library, target, limits } = &request;
            let recipes = recipes(library, target, limits, &task);
            if !matches!(recipes, Err(MatchError::Cancelled(_))) {
                let _ = sender.send(SearchResult { request, recipes });
            }
            drop(sender);
            wake();
        });
    }

    /// Cancels the running search, if any. The last result is kept.
    pub fn cancel(&mut self) {
        if let Some(running) = self.running.take() {
            running.task.cancel();
        }
    }

    /// Stores the result of the running search if it has ended. Call this once a frame.
    pub fn update(&mut self) {
        let Some(running) = &self.running else { return };
        match running.receiver.try_recv() {
            Ok(result) => {
                self.result = Some(result);
                self.running = None;
            }
            Err(TryRecvError::Disconnected) => {
                self.crashed = true;
                self.running = None;
            }
            Err(TryRecvError::Empty) => {}
        }
    }

    /// Progress of the running search, 0 to 1; `None` if no search runs.
    #[must_use]
    pub fn progress(&self) -> Option<f64> {
        self.running.as_ref().map(|running| running.task.progress().share().unwrap_or(0.0))
    }

    /// Result of the last search that ended, if any.
    #[must_use]
    pub fn result(&self) -> Option<&SearchResult> {
        self.result.as_ref()
    }

    /// Whether the last search thread ended without a result. This is a bug (a panic).
    #[must_use]
    pub fn crashed(&self) -> bool {
        self.crashed
    }
}

impl Drop for RecipeSearch {
    fn drop(&mut self) {
        self.cancel();
    }
}

#[cfg(test)]
mod tests {
    use web_time::{Duration, Instant};

    use pigment::evaluate::Viewing;
    use pigment::matching::{FilmKind, ViewingCondition};
    use spectra::color::Lab;

    use super::*;
    use pigment::library::PigmentLibrary;

    fn request_for(lightness: f64, at_most: usize) -> SearchRequest {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let conditions = vec![ViewingCondition { viewing: Viewing::default(), weight: 1.0 }];
        let target = Target::from_lab("wanted", Lab { lightness, a: 4.0, b: 9.0 }, &conditions);
        let limits =
            RecipeLimits { at_most, ..RecipeLimits::new(&library, conditions, FilmKind::Hiding) };
        SearchRequest { library, target, limits }
    }

    /// A search that takes many seconds.
    fn long_request() -> SearchRequest {
        let mut request = request_for(60.0, 8);
        let library = Arc::make_mut(&mut request.library);
        for copy in 0..2 {
            let mut copies = PigmentLibrary::van_gogh_oils().pigments;
            for pigment in &mut copies {
                pigment.name.push_str(&format!(" {copy}"));
            }
            library.pigments.extend(copies);
        }
        request.limits.allowed = library.ids().collect();
        request
    }

    fn wait(search: &mut RecipeSearch) {
        let patience = Instant::now() + Duration::from_secs(120);
        while search.progress().is_some() {
            assert!(Instant::now() < patience, "the search does not end");
            std::thread::sleep(Duration::from_millis(2));
            search.update();
        }
    }

    #[test]
    fn results_equal_those_of_the_library_search() {
        let request = request_for(50.0, 2);
        let mut search = RecipeSearch::default();
        let (woken, wakes) = channel();
        search.start(request.clone(), move || woken.send(()).unwrap());
        wait(&mut search);
        wakes.recv_timeout(Duration::from_secs(60)).unwrap();
        let result = search.result().unwrap();
        assert_eq!(result.request, request);
        let wanted =
            recipes(&request.library, &request.target, &request.limits, &Task::default()).unwrap();
        assert_eq!(result.recipes.as_ref().unwrap(), &wanted);
        assert!(!wanted.is_empty(), "the oils can mix a brown");
    }

    #[test]
    fn a_new_search_discards_the_result_of_the_older_one() {
        let old = long_request();
        let new = request_for(30.0, 1);
        let mut search = RecipeSearch::default();
        let (ended, ends) = channel();
        let of_old = ended.clone();
        search.start(old, move || of_old.send("old").unwrap());
        let task = search.running.as_ref().unwrap().task.clone();
        search.start(new.clone(), move || ended.send("new").unwrap());
        assert!(task.is_cancelled(), "the older search was asked to stop");
        // Both threads must end soon, in either order.
        for _ in 0..2 {
            ends.recv_timeout(Duration::from_secs(20)).unwrap();
        }
        wait(&mut search);
        assert_eq!(search.result().unwrap().request, new);
    }

    #[test]
    fn cancelling_ends_the_search_and_keeps_the_last_result() {
        let mut search = RecipeSearch::default();
        let first = request_for(40.0, 1);
        search.start(first.clone(), || ());
        wait(&mut search);
        let (ended, ends) = channel();
        search.start(long_request(), move || ended.send(()).unwrap());
        let task = search.running.as_ref().unwrap().task.clone();
        search.cancel();
        assert!(task.is_cancelled(), "the search was asked to stop");
        assert_eq!(search.progress(), None);
        ends.recv_timeout(Duration::from_secs(20)).expect("a cancelled search ends within 20 s");
        search.update();
        assert_eq!(search.result().unwrap().request, first);
        assert!(!search.crashed(), "a cancelled search has not crashed");
    }

    #[test]
    fn an_impossible_request_returns_the_error() {
        let mut request = request_for(50.0, 2);
        request.limits.allowed.clear();
        let mut search = RecipeSearch::default();
        search.start(request, || ());
        wait(&mut search);
        let reason = search.result().unwrap().recipes.as_ref().unwrap_err();
        assert_eq!(*reason, MatchError::NoPigments);
    }
}
