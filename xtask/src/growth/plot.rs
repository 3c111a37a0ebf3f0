//! Curves over logarithmic axes, as SVG.

use std::fmt::Write;

/// A panel: curves that share their axes.
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// What goes to the right, with its unit.
    pub x: &'static str,
    /// What goes up, with its unit.
    pub y: &'static str,
    /// The curves.
    pub curves: Vec<Curve>,
}

/// A curve through points.
pub struct Curve {
    /// As it is called beside its colour.
    pub name: &'static str,
    /// From left to right, all above zero.
    pub points: Vec<[f64; 2]>,
}

/// A panel with its margins, in units of the picture.
const PANEL: [f64; 2] = [460.0, 340.0];
const LEFT: f64 = 68.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 54.0;
const COLOURS: [&str; 4] = ["#a33b1e", "#1f5f8b", "#4d7c31", "#7a4a94"];

/// An axis: powers of ten between two steps, and where they lie in the picture.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Reaches over some values, to the next step of 1, 2, 5 on either side.
    fn over(values: impl Iterator<Item = f64> + Clone, from: f64, to: f64) -> Self {
        let least = values.clone().fold(f64::MAX, f64::min);
        let most = values.fold(f64::MIN_POSITIVE, f64::max);
        let all = steps(least / 10.0, most * 10.0);
        // Points do not lie on the frame.
        let low = all.iter().rev().find(|step| **step < least * 0.97).copied().unwrap_or(least);
        let high = all.iter().find(|step| **step > most * 1.03).copied().unwrap_or(most);
        Self { low, high, from, to }
    }

    fn at(&self, value: f64) -> f64 {
        let share = libm::log(value / self.low) / libm::log(self.high / self.low);
        self.from + (self.to - self.from) * share
    }

    /// The steps on it, and whether each has its number written.
    fn ticks(&self) -> Vec<(f64, bool)> {
        let ticks = steps(self.low, self.high);
        let many = ticks.len() > 7;
        let whole = |step: f64| (libm::log10(step) - libm::log10(step).round()).abs() < 1e-6;
        ticks.into_iter().map(|step| (step, !many || whole(step))).collect()
    }
}

/// 1, 2 and 5 of every power of ten within bounds.
fn steps(low: f64, high: f64) -> Vec<f64> {
    let decades = libm::log10(low).floor() as i32..=libm::log10(high).ceil() as i32;
    let all = decades.flat_map(|decade| [1.0, 2.0, 5.0].map(|step| step * libm::exp10(f64::from(decade))));
    all.filter(|step| (low * 0.999..=high * 1.001).contains(step)).collect()
}

/// The number of a step, beside an axis.
fn number(svg: &mut String, x: f64, y: f64, anchor: &str, step: f64) {
    let step = written(step);
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{step}</text>");
}

/// A number as it stands at an axis: with k and M, and no more digits than it needs.
fn written(value: f64) -> String {
    let (value, unit) = match value {
        _ if value >= 999_999.0 => (value / 1e6, " M"),
        _ if value >= 9_999.0 => (value / 1e3, " k"),
        _ => (value, ""),
    };
    let decimals = (-libm::log10(value).floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.decimals$}{unit}")
}

/// Draws panels side by side.
pub fn draw(plots: &[Plot]) -> String {
    let [width, height] = PANEL;
    let all = width * plots.len() as f64;
    // Writing to a string cannot fail, here and below.
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {all} {height}\" width=\"{all}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{all}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    for (index, plot) in plots.iter().enumerate() {
        let _ = writeln!(svg, "<g transform=\"translate({} 0)\">", width * index as f64);
        plot.draw(&mut svg);
        svg.push_str("</g>\n");
    }
    svg + "</svg>\n"
}

impl Plot {
    fn draw(&self, svg: &mut String) {
        let [width, height] = PANEL;
        let points = || self.curves.iter().flat_map(|curve| curve.points.iter());
        let x = Axis::over(points().map(|point| point[0]), LEFT, width - RIGHT);
        let y = Axis::over(points().map(|point| point[1]), height - BOTTOM, TOP);
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"22\" text-anchor=\"middle\" font-size=\"14\">{}</text>",
            f64::midpoint(x.from, x.to),
            self.title
        );
        self.grid(svg, &x, &y);
        self.linear(svg, &x, &y);
        for (index, (curve, colour)) in self.curves.iter().zip(COLOURS.iter().cycle()).enumerate() {
            let place = |[along, up]: &[f64; 2]| [x.at(*along), y.at(*up)];
            let path: Vec<String> =
                curve.points.iter().map(place).map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
            let _ = writeln!(
                svg,
                "<path d=\"M{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>",
                path.join("L")
            );
            for [x, y] in curve.points.iter().map(place) {
                let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"{colour}\"/>");
            }
            let line = y.to + 18.0 + 17.0 * index as f64;
            let _ = writeln!(
                svg,
                "<path d=\"M{:.1} {line:.1}h18\" stroke=\"{colour}\" stroke-width=\"2\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
                x.from + 10.0,
                x.from + 34.0,
                line + 4.0,
                curve.name
            );
        }
    }

    /// The lines of the steps, their numbers, and what the axes are.
    fn grid(&self, svg: &mut String, x: &Axis, y: &Axis) {
        for (step, numbered) in x.ticks() {
            let at = x.at(step);
            let _ = writeln!(svg, "<path d=\"M{at:.1} {:.1}V{:.1}\" stroke=\"#ddd\"/>", y.from, y.to);
            if numbered {
                number(svg, at, y.from + 17.0, "middle", step);
            }
        }
        for (step, numbered) in y.ticks() {
            let at = y.at(step);
            let _ = writeln!(svg, "<path d=\"M{:.1} {at:.1}H{:.1}\" stroke=\"#ddd\"/>", x.from, x.to);
            if numbered {
                number(svg, x.from - 7.0, at + 4.0, "end", step);
            }
        }
        let (middle, half) = (f64::midpoint(x.from, x.to), f64::midpoint(y.from, y.to));
        let _ = writeln!(
            svg,
            "<path d=\"M{:.1} {:.1}V{:.1}H{:.1}\" fill=\"none\" stroke=\"#333\"/>\n\
             <text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n\
             <text transform=\"translate(16 {half:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            x.from,
            y.to,
            y.from,
            x.to,
            y.from + 40.0,
            self.x,
            self.y
        );
    }

    /// What would grow as what goes to the right does: a dashed line through the end of the first curve.
    fn linear(&self, svg: &mut String, x: &Axis, y: &Axis) {
        let Some([along, up]) = self.curves.first().and_then(|curve| curve.points.last()) else { return };
        let slope = up / along;
        let start = x.low.max(y.low / slope);
        let end = x.high.min(y.high / slope);
        if start < end {
            let _ = writeln!(
                svg,
                "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#999\" stroke-dasharray=\"5 4\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"#777\">linear</text>",
                x.at(start),
                y.at(start * slope),
                x.at(end),
                y.at(end * slope),
                x.to - 8.0,
                y.from - 9.0
            );
            let _ = writeln!(
                svg,
                "<path d=\"M{:.1} {:.1}h18\" stroke=\"#999\" stroke-dasharray=\"5 4\"/>",
                x.to - 66.0,
                y.from - 13.0
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_reaches_to_the_next_step_on_either_side() {
        let axis = Axis::over([0.03, 4.0].into_iter(), 0.0, 100.0);
        assert!(
            (axis.low - 0.02).abs() < 1e-12 && (axis.high - 5.0).abs() < 1e-12,
            "{} {}",
            axis.low,
            axis.high
        );
        assert!((axis.at(0.02) - 0.0).abs() < 1e-9 && (axis.at(5.0) - 100.0).abs() < 1e-9);
        // A power of ten is as wide everywhere.
        assert!((axis.at(1.0) - axis.at(0.1) - (axis.at(0.5) - axis.at(0.05))).abs() < 1e-9);
        let numbered: Vec<f64> =
            axis.ticks().into_iter().filter(|(_, numbered)| *numbered).map(|tick| tick.0).collect();
        assert_eq!(numbered.len(), 2, "{numbered:?}");
    }

    #[test]
    fn numbers_are_short() {
        let all = [0.005, 0.1, 2.0, 500.0, 5000.0, 10_000.0, 200_000.0, 1e6, 5e6].map(written);
        assert_eq!(all, ["0.005", "0.1", "2", "500", "5000", "10 k", "200 k", "1 M", "5 M"]);
    }

    #[test]
    fn every_point_lies_in_its_panel() {
        let curve = Curve { name: "one", points: vec![[1e4, 0.01], [1e5, 0.4], [4e6, 2.5]] };
        let plot = Plot { title: "growth".to_owned(), x: "triangles", y: "s", curves: vec![curve] };
        let svg = draw(&[plot]);
        assert_eq!(svg.matches("<circle").count(), 3);
        for circle in svg.split("<circle ").skip(1) {
            let numbers: Vec<f64> = circle
                .split('"')
                .skip(1)
                .step_by(2)
                .take(2)
                .map(|number| number.parse().expect("a number"))
                .collect();
            let [x, y] = numbers[..] else { panic!("{circle}") };
            assert!(
                (LEFT..PANEL[0] - RIGHT).contains(&x) && (TOP..PANEL[1] - BOTTOM).contains(&y),
                "{circle}"
            );
        }
    }
}
