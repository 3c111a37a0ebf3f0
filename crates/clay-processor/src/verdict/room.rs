//! Where the nozzle may be.

use super::findings::Findings;
use super::limits::Bed;
use super::rule::Rule;

/// Below this a place is on the border: programs round to three decimals, mm.
const ROUNDING: f64 = 0.002;

/// How far a place lies outside the bed, mm; 0 or less if it is on it.
fn outside(bed: &Bed, (x, y): (f64, f64)) -> f64 {
    if !bed.round {
        let (left, front) = (bed.least.0 - x, bed.least.1 - y);
        return left.max(front).max(x - bed.greatest.0).max(y - bed.greatest.1);
    }
    let (a, b) = ((bed.greatest.0 - bed.least.0) / 2.0, (bed.greatest.1 - bed.least.1) / 2.0);
    let (x, y) = (x - bed.least.0 - a, y - bed.least.1 - b);
    let share = (x / a).hypot(y / b);
    // Along the line to the middle; on a circle that is the distance from it.
    if share > 1.0 { x.hypot(y) * (1.0 - 1.0 / share) } else { 0.0 }
}

/// Looks at one place where the nozzle is, at the height `z` as the file calls it and the altitude from the bed.
pub(crate) fn look(
    bed: Option<&Bed>,
    findings: &mut Findings,
    index: usize,
    prints: bool,
    place: Option<(f64, f64)>,
    altitude: Option<f64>,
) {
    if let Some(altitude) = altitude
        && (altitude < 0.0 || prints && altitude <= 0.0)
    {
        findings.add(Rule::BelowBed, index, Some(altitude), -altitude);
    }
    let Some(bed) = bed else { return };
    if let Some(beyond) = altitude.map(|altitude| altitude - bed.height).filter(|beyond| *beyond > ROUNDING) {
        let rule = if prints { Rule::AboveMachine } else { Rule::TravelOutside };
        findings.add(rule, index, altitude, beyond);
    }
    if let Some(beyond) = place.map(|place| outside(bed, place)).filter(|beyond| *beyond > ROUNDING) {
        let rule = if prints { Rule::OutsideBed } else { Rule::TravelOutside };
        findings.add(rule, index, altitude, beyond);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bed_ends_where_its_outline_is() {
        let square = Bed { least: (0.0, 0.0), greatest: (200.0, 100.0), round: false, height: 50.0 };
        let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        near(outside(&square, (200.0, 100.0)), 0.0);
        near(outside(&square, (203.0, 50.0)), 3.0);
        near(outside(&square, (50.0, -2.0)), 2.0);
        let round = Bed { least: (-100.0, -100.0), greatest: (100.0, 100.0), round: true, height: 50.0 };
        near(outside(&round, (100.0, 0.0)), 0.0);
        near(outside(&round, (0.0, -105.0)), 5.0);
        near(outside(&round, (80.0, 80.0)), 80.0 * 2.0_f64.sqrt() - 100.0);
        near(
            outside(&Bed { least: (0.0, 0.0), greatest: (200.0, 200.0), ..round }, (180.0, 180.0)),
            80.0 * 2.0_f64.sqrt() - 100.0,
        );
        assert!(outside(&round, (70.0, 70.0)) <= 0.0);
    }
}
