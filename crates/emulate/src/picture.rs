//! Pictures: the deposits of a part, coloured by a column, as SVG.

use crate::error::Error;
use crate::part::{AdditivePart, chords};
use crate::process::Action;
use crate::table::{Column, Table};
use std::fmt::Write;

/// From where a part is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// From above.
    #[default]
    Top,
    /// From the front, along Y.
    Front,
    /// One layer from above, with its travels; layers are counted from zero, as in the column `layer`.
    Layer(usize),
}

/// So many colours are told apart; an eye tells fewer.
const SHADES: usize = 64;
/// The scale, from low to high: from dark blue over green to yellow, evenly brighter, and so for the colour-blind too.
const SCALE: [[f64; 3]; 5] =
    [[68.0, 1.0, 84.0], [59.0, 82.0, 139.0], [33.0, 145.0, 140.0], [94.0, 201.0, 98.0], [253.0, 231.0, 37.0]];
/// How far a chord may lie beside its arc, as a part of the picture's size.
const FINENESS: f64 = 1e-4;

/// Draws the deposits of a part as SVG, every step in the colour of its value in `column`. The bytes depend on nothing
/// else.
///
/// ```
/// use emulate::{AdditivePart, Bead, Commands, Machine, View, picture};
///
/// let program = b"M83\nG1 Z2 F600\nG1 X100 E5 F3000\nG1 Y100 E5 F1500\n";
/// let operation = Machine::default().process_additive(Commands::read(program).steps)?;
/// let part = AdditivePart::new(&operation, Bead::default(), [0.0, 0.0, 1.0])?;
/// let svg = picture(&part, "feedrate", View::Top)?;
/// assert!(svg.starts_with("<svg") && svg.contains(">feedrate<") && svg.contains(">50<"));
/// # Ok::<(), emulate::Error>(())
/// ```
///
/// # Errors
/// When there is no such column or it has no numbers, no such layer, or nothing to draw.
pub fn picture(part: &AdditivePart<'_, '_>, column: &str, view: View) -> Result<String, Error> {
    let table = Table::of_part(part);
    let values = values(&table, column)?;
    if let View::Layer(layer) = view
        && layer >= part.n_layers()
    {
        return Err(Error::new(format!("there is no layer {layer}"))
            .hint(format!("the part has {} layers, counted from 0", part.n_layers())));
    }
    let process = part.operation().process_data();
    let wanted = |action: Action, index: usize| {
        process.action()[index] == action
            && match view {
                View::Layer(layer) => part.step_layers()[index] as usize == layer,
                _ => true,
            }
    };
    let deposits: Vec<usize> = (0..process.len()).filter(|&index| wanted(Action::Deposit, index)).collect();
    let Some(frame) = Frame::around(part, view, &deposits) else {
        return Err(Error::new("nothing is deposited, so there is nothing to draw"));
    };
    let numbers = || deposits.iter().filter_map(|&index| values.number(index));
    let (low, high) = (numbers().fold(f64::INFINITY, f64::min), numbers().fold(f64::NEG_INFINITY, f64::max));
    let shade = |index: usize| {
        let share = (values.number(index).unwrap_or(low) - low) / (high - low);
        // Where all are equal there is no share.
        if share.is_finite() { (share * (SHADES - 1) as f64).round() as usize } else { SHADES / 2 }
    };

    let mut svg = frame.head();
    if matches!(view, View::Layer(_)) {
        let width = frame.width * 0.15;
        let _ = writeln!(svg, "<g fill=\"none\" stroke=\"#bbb\" stroke-width=\"{width:.3}\">");
        for index in (0..process.len()).filter(|&index| wanted(Action::Travel, index)) {
            frame.line(&mut svg, part, index, index + 1);
        }
        svg.push_str("</g>\n");
    }
    let _ = writeln!(
        svg,
        "<g fill=\"none\" stroke-width=\"{:.3}\" stroke-linecap=\"round\" stroke-linejoin=\"round\">",
        frame.width
    );
    for run in deposits.chunk_by(|&one, &next| next == one + 1 && shade(one) == shade(next)) {
        if let [first, .., last] | [first @ last] = run {
            let _ = write!(svg, "<g stroke=\"{}\">", colour(shade(*first) as f64 / (SHADES - 1) as f64));
            frame.line(&mut svg, part, *first, last + 1);
            svg.push_str("</g>\n");
        }
    }
    svg.push_str("</g>\n");
    frame.legend(&mut svg, column, low, high);
    svg.push_str("</svg>\n");
    Ok(svg)
}

fn values<'t>(table: &'t Table<'_>, name: &str) -> Result<&'t Column<'t>, Error> {
    let numeric = |column: &Column<'_>| !matches!(column, Column::Word(_));
    table.column(name).filter(|column| numeric(column)).ok_or_else(|| {
        let known = table.columns().iter().filter(|(_, column)| numeric(column)).map(|(name, _)| *name);
        Error::new(format!("there is no column of numbers `{name}`"))
            .hint(format!("there are {}", known.collect::<Vec<_>>().join(", ")))
    })
}

/// A colour of the scale; `share` goes from 0 to 1.
fn colour(share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
    let from = (at as usize).min(SCALE.len() - 2);
    let [red, green, blue] = std::array::from_fn(|part| {
        let (low, high) = (SCALE[from][part], SCALE[from + 1][part]);
        (low + (high - low) * (at - from as f64)).round() as u8
    });
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// What of the room is in the picture, in mm; the picture's y goes down.
struct Frame {
    /// The axis that goes up in the picture: Y or Z.
    up: usize,
    left: f64,
    top: f64,
    size: [f64; 2],
    /// The width of the strokes.
    width: f64,
}

impl Frame {
    fn around(part: &AdditivePart<'_, '_>, view: View, deposits: &[usize]) -> Option<Self> {
        let process = part.operation().process_data();
        let mut bounds: Option<crate::Bounds> = None;
        for &index in deposits {
            let step = crate::Bounds::of_step(process, index);
            match &mut bounds {
                Some(bounds) => bounds.merge(&step),
                None => bounds = Some(step),
            }
        }
        let bounds = bounds?;
        let bead = part.bead();
        let (up, width) = if view == View::Front { (2, bead.height) } else { (1, bead.width) };
        let margin = bead.width;
        Some(Self {
            up,
            left: bounds.min[0] - margin,
            top: bounds.max[up] + margin,
            size: [
                bounds.max[0] - bounds.min[0] + 2.0 * margin,
                bounds.max[up] - bounds.min[up] + 2.0 * margin,
            ],
            // Neighbours can be told apart.
            width: 0.85 * width,
        })
    }

    /// The larger side, mm, by which everything beside the part is measured.
    fn side(&self) -> f64 {
        self.size[0].max(self.size[1])
    }

    /// The room for the legend, mm.
    fn legend_width(&self) -> f64 {
        0.25 * self.side()
    }

    fn head(&self) -> String {
        let (width, height) = (self.size[0] + self.legend_width(), self.size[1].max(0.6 * self.side()));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.3} {height:.3}\" \
             width=\"1000\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        )
    }

    fn point(&self, at: [f64; 3]) -> (f64, f64) {
        (at[0] - self.left, self.top - at[self.up])
    }

    /// The steps from `first` to before `end`, in one line.
    fn line(&self, svg: &mut String, part: &AdditivePart<'_, '_>, first: usize, end: usize) {
        let process = part.operation().process_data();
        let (x, y) = self.point(process.start(first));
        let _ = write!(svg, "<path d=\"M{x:.3} {y:.3}");
        for index in first..end {
            for at in chords(process, index, FINENESS * self.side()) {
                let (x, y) = self.point(at);
                let _ = write!(svg, "L{x:.3} {y:.3}");
            }
        }
        svg.push_str("\"/>");
    }

    fn legend(&self, svg: &mut String, column: &str, low: f64, high: f64) {
        const STOPS: usize = 16;
        let unit = self.side() / 100.0;
        let (left, top, height) = (self.size[0] + 2.0 * unit, 8.0 * unit, 45.0 * unit);
        svg.push_str("<defs><linearGradient id=\"scale\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">");
        for stop in 0..=STOPS {
            let share = stop as f64 / STOPS as f64;
            let _ = write!(svg, "<stop offset=\"{share}\" stop-color=\"{}\"/>", colour(share));
        }
        svg.push_str("</linearGradient></defs>\n");
        let _ = writeln!(
            svg,
            "<rect x=\"{left:.3}\" y=\"{top:.3}\" width=\"{:.3}\" height=\"{height:.3}\" fill=\"url(#scale)\"/>\n\
             <g font-family=\"sans-serif\" font-size=\"{:.3}\">",
            3.0 * unit,
            2.6 * unit
        );
        let mut say = |x: f64, y: f64, text: &str| {
            let _ = writeln!(svg, "<text x=\"{x:.3}\" y=\"{y:.3}\">{text}</text>");
        };
        say(left, top - 3.0 * unit, column);
        for (share, value) in [(1.0, high), (0.5, 0.5 * (low + high)), (0.0, low)] {
            say(left + 4.0 * unit, top + (1.0 - share) * height + unit, &short(value));
        }
        svg.push_str("</g>\n");
    }
}

/// A number of a legend: four digits are enough.
fn short(value: f64) -> String {
    let digits = match value.abs() {
        size if size >= 1000.0 => 0,
        size if size >= 100.0 => 1,
        size if size >= 10.0 => 2,
        _ => 3,
    };
    let text = format!("{value:.digits$}");
    if digits == 0 { text } else { text.trim_end_matches('0').trim_end_matches('.').to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bead, Commands, Machine};

    #[test]
    fn the_scale_goes_through_its_colours() {
        assert_eq!([colour(0.0), colour(0.5), colour(1.0)], ["#440154", "#21918c", "#fde725"]);
        assert_eq!(
            [short(1234.5), short(50.0), short(0.1 + 0.2), short(-2.5)],
            ["1234", "50", "0.3", "-2.5"]
        );
    }

    #[test]
    fn every_deposit_is_drawn_once_in_the_colour_of_its_value() {
        let text =
            b"M83\nG1 Z1 F600\nG1 X10 E1 F600\nG1 Y10 E1\nG1 X0 E1 F1200\nG1 Z2\nG1 Y5\nG1 X10 E1 F1800\n";
        let operation = Machine::default().process_additive(Commands::read(text).steps).expect("sound");
        let bead = Bead { width: 2.0, height: 1.0, ..Bead::default() };
        let part = AdditivePart::new(&operation, bead, [0.0, 0.0, 1.0]).expect("a part");
        let svg = |view| picture(&part, "feedrate", view).expect("a picture");
        let strokes = |svg: &str| -> Vec<String> {
            svg.match_indices("<g stroke=\"#").map(|(at, _)| svg[at + 11..at + 18].to_owned()).collect()
        };
        // 10, 10, 20 and 30 mm/s: two of one colour are one line.
        assert_eq!(strokes(&svg(View::Top)), [colour(0.0), colour(32.0 / 63.0), colour(1.0)]);
        assert!(svg(View::Top).contains("M2.000 12.000L12.000 12.000L12.000 2.000\""), "{}", svg(View::Top));
        // Layer 1 has one value, so the middle of the scale, and the travel to its beginning.
        assert_eq!(strokes(&svg(View::Layer(1))).len(), 1);
        assert!(svg(View::Layer(1)).contains("#bbb"));
        assert!(svg(View::Front).contains("M2.000 3.000L12.000 3.000"), "{}", svg(View::Front));
        for (column, view, why) in [
            ("colour", View::Top, "there is no column of numbers `colour`"),
            ("command", View::Top, "there is no column of numbers `command`"),
            ("x", View::Layer(2), "there is no layer 2"),
        ] {
            assert_eq!(picture(&part, column, view).expect_err(why).message, why);
        }
    }
}
