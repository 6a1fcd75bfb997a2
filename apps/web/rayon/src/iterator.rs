//! Iterator methods that handle one item after the other.

use std::cmp::Ordering;
use std::iter;

/// Items, one after the other, with the methods of a parallel iterator.
#[derive(Debug, Clone)]
pub struct Serial<I>(pub(crate) I);

impl<I: Iterator> IntoIterator for Serial<I> {
    type Item = I::Item;
    type IntoIter = I;

    fn into_iter(self) -> I {
        self.0
    }
}

/// An iterator that could use several threads. The methods work as in [`Iterator`], unless this
/// says something else.
pub trait ParallelIterator: IntoIterator + Sized {
    /// Does the work of [`Iterator::map`].
    fn map<R, F: FnMut(Self::Item) -> R>(self, map: F) -> Serial<iter::Map<Self::IntoIter, F>> {
        Serial(self.into_iter().map(map))
    }

    /// Maps with a state that a thread would make once.
    fn map_init<T, R>(
        self,
        init: impl Fn() -> T,
        map: impl Fn(&mut T, Self::Item) -> R,
    ) -> Serial<impl Iterator<Item = R>> {
        let mut state = init();
        Serial(self.into_iter().map(move |item| map(&mut state, item)))
    }

    /// Does the work of [`Iterator::filter`].
    fn filter<F: FnMut(&Self::Item) -> bool>(
        self,
        keep: F,
    ) -> Serial<iter::Filter<Self::IntoIter, F>> {
        Serial(self.into_iter().filter(keep))
    }

    /// Does the work of [`Iterator::filter_map`].
    fn filter_map<R, F: FnMut(Self::Item) -> Option<R>>(
        self,
        map: F,
    ) -> Serial<iter::FilterMap<Self::IntoIter, F>> {
        Serial(self.into_iter().filter_map(map))
    }

    /// Does the work of [`Iterator::flat_map`].
    fn flat_map<R: IntoIterator, F: FnMut(Self::Item) -> R>(
        self,
        map: F,
    ) -> Serial<iter::FlatMap<Self::IntoIter, R, F>> {
        Serial(self.into_iter().flat_map(map))
    }

    /// Does the work of [`Iterator::flat_map`].
    fn flat_map_iter<R: IntoIterator, F: FnMut(Self::Item) -> R>(
        self,
        map: F,
    ) -> Serial<iter::FlatMap<Self::IntoIter, R, F>> {
        self.flat_map(map)
    }

    /// Does the work of [`Iterator::flatten`].
    fn flatten(self) -> Serial<iter::Flatten<Self::IntoIter>>
    where
        Self::Item: IntoIterator,
    {
        Serial(self.into_iter().flatten())
    }

    /// Does the work of [`Iterator::for_each`].
    fn for_each(self, act: impl FnMut(Self::Item)) {
        self.into_iter().for_each(act);
    }

    /// Acts with a state that a thread would make once.
    fn for_each_init<T>(self, init: impl Fn() -> T, act: impl Fn(&mut T, Self::Item)) {
        let mut state = init();
        self.into_iter().for_each(|item| act(&mut state, item));
    }

    /// Acts until the first error, and returns it.
    ///
    /// # Errors
    /// The error of `act`.
    fn try_for_each<E>(self, act: impl FnMut(Self::Item) -> Result<(), E>) -> Result<(), E> {
        self.into_iter().try_for_each(act)
    }

    /// Acts until the first error, and returns it. Makes the state once, as one thread would.
    ///
    /// # Errors
    /// The error of `act`.
    fn try_for_each_init<T, E>(
        self,
        init: impl Fn() -> T,
        act: impl Fn(&mut T, Self::Item) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut state = init();
        self.into_iter().try_for_each(|item| act(&mut state, item))
    }

    /// Joins all items, starting with `identity`.
    fn reduce(
        self,
        identity: impl Fn() -> Self::Item,
        join: impl FnMut(Self::Item, Self::Item) -> Self::Item,
    ) -> Self::Item {
        self.into_iter().fold(identity(), join)
    }

    /// Joins all items. Returns `None` if there are no items.
    fn reduce_with(
        self,
        join: impl FnMut(Self::Item, Self::Item) -> Self::Item,
    ) -> Option<Self::Item> {
        self.into_iter().reduce(join)
    }

    /// Does the work of [`Iterator::collect`].
    fn collect<C: FromIterator<Self::Item>>(self) -> C {
        self.into_iter().collect()
    }

    /// Does the work of [`Iterator::unzip`].
    fn unzip<A, B, FromA, FromB>(self) -> (FromA, FromB)
    where
        Self: IntoIterator<Item = (A, B)>,
        FromA: Default + Extend<A>,
        FromB: Default + Extend<B>,
    {
        self.into_iter().unzip()
    }

    /// Does the work of [`Iterator::sum`].
    fn sum<S: iter::Sum<Self::Item>>(self) -> S {
        self.into_iter().sum()
    }

    /// Does the work of [`Iterator::count`].
    fn count(self) -> usize {
        self.into_iter().count()
    }

    /// Does the work of [`Iterator::max`].
    fn max(self) -> Option<Self::Item>
    where
        Self::Item: Ord,
    {
        self.into_iter().max()
    }

    /// Does the work of [`Iterator::min_by`].
    fn min_by(
        self,
        compare: impl FnMut(&Self::Item, &Self::Item) -> Ordering,
    ) -> Option<Self::Item> {
        self.into_iter().min_by(compare)
    }

    /// Does the work of [`Iterator::all`].
    fn all(self, holds: impl FnMut(Self::Item) -> bool) -> bool {
        self.into_iter().all(holds)
    }

    /// Does the work of [`Iterator::any`].
    fn any(self, holds: impl FnMut(Self::Item) -> bool) -> bool {
        self.into_iter().any(holds)
    }
}

impl<I: Iterator> ParallelIterator for Serial<I> {}

/// An iterator that knows how many items it has.
pub trait IndexedParallelIterator: ParallelIterator {
    /// Returns itself, because there are no parts that could be too short.
    #[must_use]
    fn with_min_len(self, _: usize) -> Self {
        self
    }

    /// Does the work of [`Iterator::enumerate`].
    fn enumerate(self) -> Serial<iter::Enumerate<Self::IntoIter>> {
        Serial(self.into_iter().enumerate())
    }

    /// Does the work of [`Iterator::skip`].
    fn skip(self, count: usize) -> Serial<iter::Skip<Self::IntoIter>> {
        Serial(self.into_iter().skip(count))
    }

    /// Does the work of [`Iterator::take`].
    fn take(self, count: usize) -> Serial<iter::Take<Self::IntoIter>> {
        Serial(self.into_iter().take(count))
    }

    /// Does the work of [`Iterator::step_by`].
    fn step_by(self, step: usize) -> Serial<iter::StepBy<Self::IntoIter>> {
        Serial(self.into_iter().step_by(step))
    }

    /// Does the work of [`Iterator::zip`].
    fn zip<Z: IntoIterator>(self, other: Z) -> Serial<iter::Zip<Self::IntoIter, Z::IntoIter>> {
        Serial(self.into_iter().zip(other))
    }

    /// Replaces what `list` holds by the items.
    fn collect_into_vec(self, list: &mut Vec<Self::Item>) {
        list.clear();
        list.extend(self);
    }
}

impl<I: Iterator> IndexedParallelIterator for Serial<I> {}
