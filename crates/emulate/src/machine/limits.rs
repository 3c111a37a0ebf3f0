//! What the machine can do, and what a file says about that.

use crate::motion::{Smoothing, least};
use gcode::{Command, Flavor, Quantity};
use std::f64::consts::SQRT_2;

/// How corners are limited.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Corner {
    /// They may be cut by so many mm.
    Deviation(f64),
    /// A right angle is passed with this speed, mm/s: Klipper's square corner velocity, and what is left of the jerk of
    /// Marlin and RepRapFirmware in a planner of this kind.
    SquareSpeed(f64),
}

impl Corner {
    /// The junction deviation under an acceleration, mm: jd = v²·(√2 − 1)/a.
    #[inline]
    pub fn deviation(self, acceleration: f64) -> f64 {
        match self {
            Self::Deviation(deviation) => deviation,
            Self::SquareSpeed(speed) if acceleration.is_finite() => {
                speed * speed * (SQRT_2 - 1.0) / acceleration
            }
            Self::SquareSpeed(_) => 0.0,
        }
    }
}

/// Limits of speed and acceleration. Infinite is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The highest speed along the path, mm/s.
    pub speed: f64,
    /// The highest speeds of X, Y, Z and the extruder, mm/s.
    pub axis_speed: [f64; 4],
    /// The highest accelerations of X, Y, Z and the extruder, mm/s².
    pub axis_acceleration: [f64; 4],
    /// The acceleration while clay comes out, mm/s².
    pub print: f64,
    /// The acceleration of moves without clay, mm/s².
    pub travel: f64,
    /// The acceleration of the extruder alone, mm/s².
    pub retract: f64,
    /// Corners; nothing leaves them to the planner.
    pub corner: Option<Corner>,
    /// How much of short moves is cruised through; nothing leaves it to the planner.
    pub smoothing: Option<Smoothing>,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            speed: f64::INFINITY,
            axis_speed: [f64::INFINITY; 4],
            axis_acceleration: [f64::INFINITY; 4],
            print: f64::INFINITY,
            travel: f64::INFINITY,
            retract: f64::INFINITY,
            corner: None,
            smoothing: None,
        }
    }
}

impl Limits {
    /// All accelerations at once, mm/s².
    #[must_use]
    pub fn with_acceleration(mut self, acceleration: f64) -> Self {
        (self.print, self.travel, self.retract) = (acceleration, acceleration, acceleration);
        self
    }

    /// Takes what a command says about limits, in the words of a flavor.
    pub fn obey(&mut self, command: &Command<'_>, flavor: &Flavor) {
        let knows = |quantity| flavor.limits.iter().any(|limit| limit.quantity == quantity);
        for limit in flavor.limits.iter() {
            let Some(value) = limit.of(command) else { continue };
            match limit.quantity {
                Quantity::Acceleration => {
                    self.print = value;
                    // Where the other kinds of move have no words of their own, this holds for them too.
                    if !knows(Quantity::TravelAcceleration) {
                        self.travel = value;
                    }
                    if !knows(Quantity::RetractAcceleration) {
                        self.retract = value;
                    }
                }
                Quantity::TravelAcceleration => self.travel = value,
                Quantity::RetractAcceleration => self.retract = value,
                Quantity::AxisAcceleration(axis) => set(&mut self.axis_acceleration, axis, value),
                Quantity::Speed => self.speed = value,
                Quantity::AxisSpeed(axis) => set(&mut self.axis_speed, axis, value),
                Quantity::JunctionDeviation => self.corner = Some(Corner::Deviation(value)),
                Quantity::CornerSpeed | Quantity::AxisJerk(0) => {
                    self.corner = Some(Corner::SquareSpeed(value))
                }
                Quantity::AxisJerk(_) => {}
                Quantity::CruiseRatio => self.smoothing = Some(Smoothing::CruiseRatio(value)),
                Quantity::AccelerationToDeceleration => self.smoothing = Some(Smoothing::AccelToDecel(value)),
            }
        }
    }
}

fn set(axes: &mut [f64; 4], axis: u8, value: f64) {
    if let Some(limit) = axes.get_mut(usize::from(axis)) {
        *limit = value;
    }
}

/// The least of the limits of axes that have these shares of what is limited: for each mm of way so many mm of the axis.
/// An axis without a share has no say.
#[inline]
pub(crate) fn along(limits: &[f64; 4], shares: &[f64; 4]) -> f64 {
    let limits = limits.iter().zip(shares).map(|(limit, share)| limit / share);
    limits.fold(f64::INFINITY, least)
}

/// Whether any of the limits is one.
pub(crate) fn any(limits: &[f64; 4]) -> bool {
    limits.iter().any(|limit| limit.is_finite())
}
