//! Where items come from, and lists that take them.

use std::slice::{Chunks, ChunksExactMut, ChunksMut};

use crate::iterator::Serial;

/// A collection that hands over its items by value.
pub trait IntoParallelIterator: IntoIterator + Sized {
    /// Does the work of [`IntoIterator::into_iter`].
    fn into_par_iter(self) -> Serial<Self::IntoIter> {
        Serial(self.into_iter())
    }
}

impl<T: IntoIterator> IntoParallelIterator for T {}

/// A collection that you can read by reference.
pub trait IntoParallelRefIterator<'data> {
    /// Iterator over references.
    type Iter;

    /// Does the work of [`slice::iter`].
    fn par_iter(&'data self) -> Serial<Self::Iter>;
}

impl<'data, T: 'data + ?Sized> IntoParallelRefIterator<'data> for T
where
    &'data T: IntoIterator,
{
    type Iter = <&'data T as IntoIterator>::IntoIter;

    fn par_iter(&'data self) -> Serial<Self::Iter> {
        Serial(self.into_iter())
    }
}

/// A collection that you can change in place.
pub trait IntoParallelRefMutIterator<'data> {
    /// Iterator over references.
    type Iter;

    /// Does the work of [`slice::iter_mut`].
    fn par_iter_mut(&'data mut self) -> Serial<Self::Iter>;
}

impl<'data, T: 'data + ?Sized> IntoParallelRefMutIterator<'data> for T
where
    &'data mut T: IntoIterator,
{
    type Iter = <&'data mut T as IntoIterator>::IntoIter;

    fn par_iter_mut(&'data mut self) -> Serial<Self::Iter> {
        Serial(self.into_iter())
    }
}

/// Parts of a list.
pub trait ParallelSlice<T> {
    /// Does the work of [`slice::chunks`].
    fn par_chunks(&self, length: usize) -> Serial<Chunks<'_, T>>;
}

impl<T> ParallelSlice<T> for [T] {
    fn par_chunks(&self, length: usize) -> Serial<Chunks<'_, T>> {
        Serial(self.chunks(length))
    }
}

/// Parts of a list that can be changed, and its order.
pub trait ParallelSliceMut<T> {
    /// Does the work of [`slice::chunks_mut`].
    fn par_chunks_mut(&mut self, length: usize) -> Serial<ChunksMut<'_, T>>;

    /// Does the work of [`slice::chunks_exact_mut`].
    fn par_chunks_exact_mut(&mut self, length: usize) -> Serial<ChunksExactMut<'_, T>>;

    /// Does the work of [`slice::sort_unstable`].
    fn par_sort_unstable(&mut self)
    where
        T: Ord;

    /// Does the work of [`slice::sort_unstable_by`].
    fn par_sort_unstable_by(&mut self, compare: impl FnMut(&T, &T) -> std::cmp::Ordering);

    /// Does the work of [`slice::sort_unstable_by_key`].
    fn par_sort_unstable_by_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K);
}

impl<T> ParallelSliceMut<T> for [T] {
    fn par_chunks_mut(&mut self, length: usize) -> Serial<ChunksMut<'_, T>> {
        Serial(self.chunks_mut(length))
    }

    fn par_chunks_exact_mut(&mut self, length: usize) -> Serial<ChunksExactMut<'_, T>> {
        Serial(self.chunks_exact_mut(length))
    }

    fn par_sort_unstable(&mut self)
    where
        T: Ord,
    {
        self.sort_unstable();
    }

    fn par_sort_unstable_by(&mut self, compare: impl FnMut(&T, &T) -> std::cmp::Ordering) {
        self.sort_unstable_by(compare);
    }

    fn par_sort_unstable_by_key<K: Ord>(&mut self, key: impl FnMut(&T) -> K) {
        self.sort_unstable_by_key(key);
    }
}

/// Lists that take the items of an iterator.
pub trait ParallelExtend<T> {
    /// Does the work of [`Extend::extend`].
    fn par_extend(&mut self, items: impl IntoIterator<Item = T>);
}

impl<T, C: Extend<T>> ParallelExtend<T> for C {
    fn par_extend(&mut self, items: impl IntoIterator<Item = T>) {
        self.extend(items);
    }
}
