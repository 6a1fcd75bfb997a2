//! A part of a file: its size and its channels with their numbers.

/// Name, size and channels that a part must have.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct PartPlan {
    pub(crate) name: String,
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Names of the channels, sorted as OpenEXR requires.
    pub(crate) channels: Vec<String>,
}

impl PartPlan {
    pub(crate) fn new(name: &str, (width, height): (usize, usize), channels: &[&str]) -> Self {
        let mut channels = channels.to_vec();
        channels.sort_unstable();
        let channels = channels.into_iter().map(str::to_owned).collect();
        Self { name: name.to_owned(), width, height, channels }
    }

    /// The part with the numbers that `plane` gives for the name of each channel.
    pub(crate) fn with(self, plane: impl Fn(&str) -> Vec<f32>) -> PartPlanes {
        let planes = self.channels.iter().map(|channel| plane(channel)).collect();
        PartPlanes { plan: self, planes }
    }
}

/// A part with its numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PartPlanes {
    pub(crate) plan: PartPlan,
    /// Numbers of each channel, row by row.
    pub(crate) planes: Vec<Vec<f32>>,
}

impl PartPlanes {
    /// Numbers of a channel; none if the part has no such channel.
    pub(crate) fn of(&self, channel: &str) -> &[f32] {
        let place = self.plan.channels.iter().position(|name| name == channel);
        place.map_or(&[], |place| &self.planes[place])
    }

    /// The first number of a channel that `possible` refuses, with its place: the channel and the
    /// reason `wanted`.
    ///
    /// # Errors
    /// Channel and reason, continuing a sentence that starts with the channel.
    pub(crate) fn check(
        &self,
        channel: &str,
        wanted: &str,
        possible: impl Fn(usize, f32) -> bool,
    ) -> Result<(), (String, String)> {
        let numbers = self.of(channel).iter().enumerate();
        match numbers.into_iter().find(|&(index, number)| !possible(index, *number)) {
            None => Ok(()),
            Some((index, found)) => {
                let x = index % self.plan.width;
                let y = index / self.plan.width;
                Err((channel.to_owned(), format!("{wanted} at x {x}, y {y}: `{found}`")))
            }
        }
    }
}
