//! Time to finish a run, from the pace of its last increments.
//!
//! Still to come are the rest of the step in increments of the present size and the
//! increments that later steps begin with. The pace is a mean of the seconds from
//! increment to increment, cut ones included, in which each counts for
//! [`WEIGHT`] of all before it.

use std::time::{Duration, Instant};

use striae_model::Model;
use striae_solve::drive::Progress as Position;

/// Weight of the last increment in the pace.
const WEIGHT: f64 = 0.2;

/// Looks ahead to the end of a run.
pub struct Forecast {
    /// Increments of every step, if their size stays what it is at first.
    planned: Vec<f64>,
    /// End of the last increment, or start of the run.
    then: Instant,
    /// Step and fraction where it ended.
    reached: Option<(usize, f64)>,
    /// Seconds an increment.
    pace: Option<f64>,
}

impl Forecast {
    /// Nothing is known but the steps of the model.
    pub fn new(model: &Model) -> Self {
        let increments = model.steps.iter().map(|step| step.increments);
        let planned = increments.map(|i| 1.0 / i.initial.min(i.largest));
        Self {
            planned: planned.collect(),
            then: Instant::now(),
            reached: None,
            pace: None,
        }
    }

    /// Time left after an increment that has ended now.
    pub fn left(&mut self, position: Position) -> Duration {
        let now = Instant::now();
        let seconds = (now - self.then).as_secs_f64();
        self.then = now;
        let increments = self.ahead(position);
        let pace = self.pace_with(seconds);
        Duration::from_secs_f64(pace * increments)
    }

    fn pace_with(&mut self, seconds: f64) -> f64 {
        let before = self.pace.unwrap_or(seconds);
        *self.pace.insert(before + WEIGHT * (seconds - before))
    }

    /// Increments after this one.
    fn ahead(&mut self, position: Position) -> f64 {
        let Position { step, fraction, .. } = position;
        let size = match self.reached {
            Some((last, done)) if last == step => fraction - done,
            _ => fraction.min(1.0 / self.planned[step]),
        };
        self.reached = Some((step, fraction));
        let later: f64 = self.planned[step + 1..].iter().sum();
        ((1.0 - fraction) / size).ceil() + later
    }
}

/// Hours, minutes and seconds.
pub fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    match hours {
        0 => format!("{minutes}:{seconds:02}"),
        _ => format!("{hours}:{minutes:02}:{seconds:02}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn forecast(planned: &[f64]) -> Forecast {
        Forecast {
            planned: planned.to_vec(),
            then: Instant::now(),
            reached: None,
            pace: None,
        }
    }

    fn at(step: usize, fraction: f64) -> Position {
        Position {
            step,
            increment: 1,
            fraction,
            time: 0.0,
        }
    }

    #[test]
    fn increments_ahead_follow_the_present_size() {
        let mut forecast = forecast(&[4.0, 10.0]);
        assert_eq!(forecast.ahead(at(0, 0.25)), 3.0 + 10.0);
        assert_eq!(forecast.ahead(at(0, 0.5)), 2.0 + 10.0);
        // Twice as fine from here on.
        assert_eq!(forecast.ahead(at(0, 0.625)), 3.0 + 10.0);
        assert_eq!(forecast.ahead(at(1, 0.0625)), 15.0);
        assert_eq!(forecast.ahead(at(1, 1.0)), 0.0);
    }

    #[test]
    fn a_resumed_run_takes_the_size_of_the_deck_at_first() {
        let mut forecast = forecast(&[4.0, 8.0]);
        assert_eq!(forecast.ahead(at(1, 0.5)), 4.0);
    }

    #[test]
    fn the_pace_is_steady_where_increments_are_and_follows_them_where_not() {
        let mut forecast = forecast(&[1.0]);
        assert_eq!(forecast.pace_with(2.0), 2.0);
        assert_eq!(forecast.pace_with(2.0), 2.0);
        assert!((forecast.pace_with(7.0) - 3.0).abs() < 1e-15);
        for _ in 0..100 {
            forecast.pace_with(7.0);
        }
        assert!((forecast.pace_with(7.0) - 7.0).abs() < 1e-8);
    }

    #[test]
    fn clocks_are_read_as_usual() {
        let read = |seconds| clock(Duration::from_secs(seconds));
        assert_eq!(
            [7, 61, 3600, 86_399].map(read),
            ["0:07", "1:01", "1:00:00", "23:59:59"]
        );
    }
}
