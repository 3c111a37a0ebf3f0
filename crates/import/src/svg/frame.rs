//! Where things are drawn: nested transforms.

use svgtypes::{TransformListParser, TransformListToken};

/// An affine transform: x' = a·x + c·y + e, y' = b·x + d·y + f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) c: f64,
    pub(super) d: f64,
    pub(super) e: f64,
    pub(super) f: f64,
}

impl Frame {
    pub(super) fn scale(x: f64, y: f64) -> Self {
        Self { a: x, b: 0.0, c: 0.0, d: y, e: 0.0, f: 0.0 }
    }

    pub(super) fn shift(x: f64, y: f64) -> Self {
        Self { e: x, f: y, ..Self::scale(1.0, 1.0) }
    }

    /// Reads a list of transforms; `None` when it is none.
    pub(super) fn read(list: &str) -> Option<Self> {
        use TransformListToken as T;
        let one = |token| match token {
            T::Matrix { a, b, c, d, e, f } => Self { a, b, c, d, e, f },
            T::Translate { tx, ty } => Self::shift(tx, ty),
            T::Scale { sx, sy } => Self::scale(sx, sy),
            T::Rotate { angle } => {
                let (sine, cosine) = (libm::sin(angle.to_radians()), libm::cos(angle.to_radians()));
                Self { a: cosine, b: sine, c: -sine, d: cosine, e: 0.0, f: 0.0 }
            }
            T::SkewX { angle } => Self { c: libm::tan(angle.to_radians()), ..Self::scale(1.0, 1.0) },
            T::SkewY { angle } => Self { b: libm::tan(angle.to_radians()), ..Self::scale(1.0, 1.0) },
        };
        TransformListParser::from(list)
            .try_fold(Self::scale(1.0, 1.0), |frame, token| Some(frame.around(one(token.ok()?))))
    }

    /// What is drawn in `inner`, which stands in this one.
    pub(super) fn around(self, inner: Self) -> Self {
        let (e, f) = self.at(inner.e, inner.f);
        Self {
            a: self.a * inner.a + self.c * inner.b,
            b: self.b * inner.a + self.d * inner.b,
            c: self.a * inner.c + self.c * inner.d,
            d: self.b * inner.c + self.d * inner.d,
            e,
            f,
        }
    }

    /// Where a point comes to lie.
    pub(super) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.a * x + self.c * y + self.e, self.b * x + self.d * y + self.f)
    }

    /// How many times a length grows at most: the larger singular value.
    pub(super) fn growth(&self) -> f64 {
        let sum = self.a * self.a + self.b * self.b + self.c * self.c + self.d * self.d;
        let area = self.area();
        ((sum + (sum * sum - 4.0 * area * area).max(0.0).sqrt()) / 2.0).sqrt()
    }

    /// How many times a length grows in the middle.
    pub(super) fn mean_growth(&self) -> f64 {
        self.area().abs().sqrt()
    }

    fn area(&self) -> f64 {
        self.a * self.d - self.b * self.c
    }
}
