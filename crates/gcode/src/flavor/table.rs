//! The flavors that are built in. Each says in what it differs from the one before it.
//!
//! Sources: the firmwares' own sources and manuals; for the Cincinnati BAAM and for Siemens what Slicer-2 writes for
//! them. No program of a CEAD machine was found in public; its extruder words are those of Slicer-2's Siemens writer and
//! can be set.

use super::{AffectsE, ArcTurns, DwellUnit, Extruder, Flavor, Limit, LimitValue, Quantity, Variables};
use crate::parameters::LengthUnit;
use std::borrow::Cow;
use std::sync::LazyLock;
use {DwellUnit::*, LimitValue::*, Quantity::*};

const fn limit(command: &'static str, word: &'static str, quantity: Quantity, value: LimitValue) -> Limit {
    Limit::new(command, word, quantity, value)
}

pub(super) fn marlin() -> Flavor {
    Flavor {
        name: Cow::Borrowed("marlin"),
        semicolon: true,
        parentheses: true,
        quotes: true,
        named_words: false,
        digit_gaps: false,
        refuses_repeated: false,
        unit: LengthUnit::Millimetre,
        unit_codes: Some((200, 210)),
        modal_motion: false,
        rapid: false,
        dwell: Cow::Borrowed(&[(b'S', Seconds), (b'P', Milliseconds)]),
        extruder: Extruder::Amount,
        bead_on: Cow::Borrowed(""),
        bead_off: Cow::Borrowed(""),
        g90_affects_e: AffectsE::Or,
        arcs: true,
        arc_radius: Cow::Borrowed("R"),
        arc_turns: ArcTurns::Extra,
        feed_modes: false,
        text_codes: Cow::Borrowed(&[160, 230, 280, 300, 320, 1170, 1180]),
        checksum: true,
        purge_code: 0,
        variables: Variables::None,
        limits: Cow::Borrowed(
            const {
                &[
                    limit("M201", "X", AxisAcceleration(0), Same),
                    limit("M201", "Y", AxisAcceleration(1), Same),
                    limit("M201", "Z", AxisAcceleration(2), Same),
                    limit("M201", "E", AxisAcceleration(3), Same),
                    limit("M203", "X", AxisSpeed(0), Same),
                    limit("M203", "Y", AxisSpeed(1), Same),
                    limit("M203", "Z", AxisSpeed(2), Same),
                    limit("M203", "E", AxisSpeed(3), Same),
                    limit("M204", "S", Acceleration, Same),
                    limit("M204", "S", TravelAcceleration, Same),
                    limit("M204", "P", Acceleration, Same),
                    limit("M204", "T", TravelAcceleration, Same),
                    limit("M204", "R", RetractAcceleration, Same),
                    limit("M205", "J", JunctionDeviation, Same),
                    limit("M205", "X", AxisJerk(0), Same),
                    limit("M205", "Y", AxisJerk(1), Same),
                    limit("M205", "Z", AxisJerk(2), Same),
                    limit("M205", "E", AxisJerk(3), Same),
                ]
            },
        ),
        decimals: 4,
        end: Cow::Borrowed(""),
    }
}

fn rep_rap_firmware() -> Flavor {
    Flavor {
        name: Cow::Borrowed("reprapfirmware"),
        rapid: true,
        g90_affects_e: AffectsE::Never,
        arc_turns: ArcTurns::None,
        text_codes: Cow::Borrowed(&[160, 230, 280, 300, 320, 1170]),
        variables: Variables::RepRap,
        limits: Cow::Borrowed(
            const {
                &[
                    limit("M201", "X", AxisAcceleration(0), Same),
                    limit("M201", "Y", AxisAcceleration(1), Same),
                    limit("M201", "Z", AxisAcceleration(2), Same),
                    limit("M201", "E", AxisAcceleration(3), Same),
                    limit("M203", "X", AxisSpeed(0), PerMinute),
                    limit("M203", "Y", AxisSpeed(1), PerMinute),
                    limit("M203", "Z", AxisSpeed(2), PerMinute),
                    limit("M203", "E", AxisSpeed(3), PerMinute),
                    limit("M204", "P", Acceleration, Same),
                    limit("M204", "T", TravelAcceleration, Same),
                    limit("M566", "X", AxisJerk(0), PerMinute),
                    limit("M566", "Y", AxisJerk(1), PerMinute),
                    limit("M566", "Z", AxisJerk(2), PerMinute),
                    limit("M566", "E", AxisJerk(3), PerMinute),
                    limit("M205", "X", AxisJerk(0), Same),
                    limit("M205", "Y", AxisJerk(1), Same),
                    limit("M205", "Z", AxisJerk(2), Same),
                    limit("M205", "E", AxisJerk(3), Same),
                ]
            },
        ),
        end: Cow::Borrowed("M0"),
        ..marlin()
    }
}

fn klipper() -> Flavor {
    Flavor {
        name: Cow::Borrowed("klipper"),
        parentheses: false,
        quotes: false,
        unit_codes: None,
        dwell: Cow::Borrowed(&[(b'P', Milliseconds)]),
        arc_radius: Cow::Borrowed(""),
        arc_turns: ArcTurns::None,
        text_codes: Cow::Borrowed(&[230, 1170, 1180]),
        limits: Cow::Borrowed(
            const {
                &[
                    limit("M204", "S", Acceleration, Same),
                    limit("SET_VELOCITY_LIMIT", "VELOCITY", Speed, Same),
                    limit("SET_VELOCITY_LIMIT", "ACCEL", Acceleration, Same),
                    limit("SET_VELOCITY_LIMIT", "SQUARE_CORNER_VELOCITY", CornerSpeed, Same),
                    limit("SET_VELOCITY_LIMIT", "MINIMUM_CRUISE_RATIO", CruiseRatio, Same),
                    limit("SET_VELOCITY_LIMIT", "ACCEL_TO_DECEL", AccelerationToDeceleration, Same),
                ]
            },
        ),
        ..marlin()
    }
}

fn grbl() -> Flavor {
    Flavor {
        name: Cow::Borrowed("grbl"),
        quotes: false,
        refuses_repeated: true,
        modal_motion: true,
        rapid: true,
        dwell: Cow::Borrowed(&[(b'P', Seconds)]),
        extruder: Extruder::None,
        arc_turns: ArcTurns::None,
        feed_modes: true,
        checksum: false,
        text_codes: Cow::Borrowed(&[]),
        limits: Cow::Borrowed(
            const {
                &[
                    limit("$11", "", JunctionDeviation, Same),
                    limit("$110", "", AxisSpeed(0), PerMinute),
                    limit("$111", "", AxisSpeed(1), PerMinute),
                    limit("$112", "", AxisSpeed(2), PerMinute),
                    limit("$120", "", AxisAcceleration(0), Same),
                    limit("$121", "", AxisAcceleration(1), Same),
                    limit("$122", "", AxisAcceleration(2), Same),
                ]
            },
        ),
        end: Cow::Borrowed("M2"),
        ..marlin()
    }
}

fn rs274() -> Flavor {
    Flavor {
        name: Cow::Borrowed("rs274"),
        digit_gaps: true,
        refuses_repeated: false,
        arc_turns: ArcTurns::Total,
        variables: Variables::Rs274,
        limits: Cow::Borrowed(&[]),
        ..grbl()
    }
}

fn cincinnati() -> Flavor {
    Flavor {
        name: Cow::Borrowed("cincinnati"),
        semicolon: false,
        digit_gaps: false,
        unit: LengthUnit::Inch,
        extruder: Extruder::Screw,
        arc_radius: Cow::Borrowed(""),
        arc_turns: ArcTurns::None,
        feed_modes: false,
        purge_code: 690,
        variables: Variables::Fanuc,
        // 10⁶ · 25.4 / 162 560 mm/s² at L1.
        limits: Cow::Borrowed(const { &[limit("M66", "L", Acceleration, Inverse(156.25))] }),
        end: Cow::Borrowed("M30"),
        ..rs274()
    }
}

fn siemens() -> Flavor {
    Flavor {
        name: Cow::Borrowed("siemens"),
        semicolon: true,
        parentheses: false,
        quotes: true,
        named_words: true,
        unit: LengthUnit::Millimetre,
        unit_codes: Some((700, 710)),
        // P is against the manual, but Slicer-2 writes it.
        dwell: Cow::Borrowed(&[(b'F', Seconds), (b'S', Revolutions), (b'P', DoubtfulSeconds)]),
        extruder: Extruder::Area,
        bead_on: Cow::Borrowed("BEAD_AREA"),
        bead_off: Cow::Borrowed("WHEN TRUE DO EXTR_END=2.0"),
        arc_radius: Cow::Borrowed("CR"),
        feed_modes: true,
        purge_code: 0,
        variables: Variables::Siemens,
        limits: Cow::Borrowed(&[]),
        ..cincinnati()
    }
}

static BUILT_IN: LazyLock<[Flavor; 7]> =
    LazyLock::new(|| [marlin(), rep_rap_firmware(), klipper(), grbl(), rs274(), cincinnati(), siemens()]);

impl Flavor {
    /// The flavors that are built in, Marlin first.
    pub fn built_in() -> &'static [Self] {
        BUILT_IN.as_slice()
    }
}
