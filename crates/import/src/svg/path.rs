//! The elements that are shapes.

use super::outline::{Pen, Trouble};
use super::page::Page;
use roxmltree::Node;
use svgtypes::{Length, PathParser, PathSegment, PointsParser};

/// Draws an element; `None` when it is no shape. Errors come with the attribute that they are about.
pub(super) fn draw(
    node: Node<'_, '_>,
    name: &str,
    page: &Page,
    pen: &mut Pen,
) -> Option<Result<(), (Trouble, &'static str)>> {
    let shape = Shape { node, page };
    Some(match name {
        "path" => path(node.attribute("d").unwrap_or_default(), pen).map_err(|trouble| (trouble, "d")),
        "rect" => shape.rectangle(pen),
        "circle" => shape.circle(pen),
        "ellipse" => shape.ellipse(pen),
        "line" => shape.line(pen),
        "polyline" | "polygon" => {
            points(node.attribute("points").unwrap_or_default(), pen, name == "polygon")
                .map_err(|trouble| (trouble, "points"))
        }
        _ => return None,
    })
}

fn points(list: &str, pen: &mut Pen, closed: bool) -> Result<(), Trouble> {
    // The parser ends at what it cannot read.
    let is_list = |byte: u8| byte.is_ascii_whitespace() || byte.is_ascii_digit() || b"+-.,eE".contains(&byte);
    if !list.bytes().all(is_list) {
        return Err(Trouble::Damaged);
    }
    for (index, point) in PointsParser::from(list).enumerate() {
        if index == 0 { pen.move_to(point)? } else { pen.line_to(point)? }
    }
    if closed {
        pen.close();
    }
    Ok(())
}

type Drawn = Result<(), (Trouble, &'static str)>;

struct Shape<'a, 'n, 'input> {
    node: Node<'n, 'input>,
    page: &'a Page,
}

impl Shape<'_, '_, '_> {
    /// A length; what is not given or `auto` is `None`.
    fn length(&self, name: &'static str, whole: f64) -> Result<Option<f64>, (Trouble, &'static str)> {
        match self.node.attribute(name).map(str::trim) {
            None | Some("auto") => Ok(None),
            Some(text) => {
                let length: Length = text.parse().map_err(|_| (Trouble::Damaged, name))?;
                Ok(Some(self.page.length(length, whole)))
            }
        }
    }

    fn two(&self, names: [&'static str; 2]) -> Result<(f64, f64), (Trouble, &'static str)> {
        let (wide, high) = self.page.window;
        let [x, y] = names;
        Ok((self.length(x, wide)?.unwrap_or(0.0), self.length(y, high)?.unwrap_or(0.0)))
    }

    fn rectangle(&self, pen: &mut Pen) -> Drawn {
        let (wide, high) = self.page.window;
        let corner = self.two(["x", "y"])?;
        let size = self.two(["width", "height"])?;
        let (rx, ry) = (self.length("rx", wide)?, self.length("ry", high)?);
        // One radius counts for both.
        let radii = (rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0));
        if size.0 <= 0.0 || size.1 <= 0.0 {
            return Ok(());
        }
        pen.rectangle(corner, size, radii).map_err(|trouble| (trouble, "width"))
    }

    fn circle(&self, pen: &mut Pen) -> Drawn {
        let (wide, high) = self.page.window;
        // Percent of a radius are of the diagonal (SVG 1.1, 7.10).
        let radius = self.length("r", libm::hypot(wide, high) / std::f64::consts::SQRT_2)?.unwrap_or(0.0);
        if radius <= 0.0 {
            return Ok(());
        }
        pen.ellipse(self.two(["cx", "cy"])?, (radius, radius)).map_err(|trouble| (trouble, "r"))
    }

    fn ellipse(&self, pen: &mut Pen) -> Drawn {
        let radii = self.two(["rx", "ry"])?;
        if radii.0 <= 0.0 || radii.1 <= 0.0 {
            return Ok(());
        }
        pen.ellipse(self.two(["cx", "cy"])?, radii).map_err(|trouble| (trouble, "rx"))
    }

    fn line(&self, pen: &mut Pen) -> Drawn {
        let said = |trouble| (trouble, "x1");
        pen.move_to(self.two(["x1", "y1"])?).map_err(said)?;
        pen.line_to(self.two(["x2", "y2"])?).map_err(said)
    }
}

/// Where the control point of the last curve was, which a smooth one mirrors.
enum Control {
    None,
    Cubic((f64, f64)),
    Quadratic((f64, f64)),
}

fn path(data: &str, pen: &mut Pen) -> Result<(), Trouble> {
    use PathSegment as S;
    let mut control = Control::None;
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|_| Trouble::Damaged)?;
        let here = pen.here();
        let from = if segment.is_abs() { (0.0, 0.0) } else { here };
        let at = |x: f64, y: f64| (from.0 + x, from.1 + y);
        let mirrored = |control: (f64, f64)| (2.0 * here.0 - control.0, 2.0 * here.1 - control.1);
        let mut next = Control::None;
        match segment {
            S::MoveTo { x, y, .. } => pen.move_to(at(x, y))?,
            S::LineTo { x, y, .. } => pen.line_to(at(x, y))?,
            S::HorizontalLineTo { x, .. } => pen.line_to((from.0 + x, here.1))?,
            S::VerticalLineTo { y, .. } => pen.line_to((here.0, from.1 + y))?,
            S::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                next = Control::Cubic(at(x2, y2));
                pen.cubic(at(x1, y1), at(x2, y2), at(x, y))?;
            }
            S::SmoothCurveTo { x2, y2, x, y, .. } => {
                let first = if let Control::Cubic(last) = control { mirrored(last) } else { here };
                next = Control::Cubic(at(x2, y2));
                pen.cubic(first, at(x2, y2), at(x, y))?;
            }
            S::Quadratic { x1, y1, x, y, .. } => {
                next = Control::Quadratic(at(x1, y1));
                pen.quadratic(at(x1, y1), at(x, y))?;
            }
            S::SmoothQuadratic { x, y, .. } => {
                let by = if let Control::Quadratic(last) = control { mirrored(last) } else { here };
                next = Control::Quadratic(by);
                pen.quadratic(by, at(x, y))?;
            }
            S::EllipticalArc { rx, ry, x_axis_rotation, large_arc, sweep, x, y, .. } => {
                pen.arc((rx, ry), x_axis_rotation, (large_arc, sweep), at(x, y))?;
            }
            S::ClosePath { .. } => pen.close(),
        }
        control = next;
    }
    Ok(())
}

#[cfg(test)]
pub(super) fn ways(data: &str, tolerance: f64) -> Result<Vec<super::outline::Way>, Trouble> {
    let mut pen = Pen::new(tolerance, 1_000_000);
    path(data, &mut pen)?;
    Ok(pen.ways)
}
