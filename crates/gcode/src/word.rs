//! Codes, such as `G1`, and words, such as `X5`.

/// What a line orders, such as `G1` or `M104`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Code {
    /// In upper case.
    pub letter: u8,
    /// In thousandths, so that `G91.1` is not `G91` and `G1.0` is `G1`.
    pub thousandths: i32,
}

impl Code {
    /// The command of a letter and a number. Nothing if the number has more than three decimals or is out of reach: no
    /// machine has such a command.
    #[inline]
    pub fn new(letter: u8, number: f64) -> Option<Self> {
        const LARGEST: f64 = 1e6;
        if number.abs() > LARGEST {
            return None;
        }
        let thousandths = number * 1000.0;
        // The cast is exact after the test above, and faster than rounding.
        let whole = (thousandths + if number < 0.0 { -0.5 } else { 0.5 }) as i32;
        ((thousandths - f64::from(whole)).abs() < 1e-6)
            .then_some(Self { letter: letter.to_ascii_uppercase(), thousandths: whole })
    }

    /// `G` and a whole number.
    pub const fn g(number: u16) -> Self {
        Self { letter: b'G', thousandths: number as i32 * 1000 }
    }

    /// `M` and a whole number.
    pub const fn m(number: u16) -> Self {
        Self { letter: b'M', thousandths: number as i32 * 1000 }
    }
}

/// The words of a line: at most one number for each letter. Of two words with one letter the first counts.
#[derive(Clone, Debug, Default)]
pub struct Words {
    values: [f64; 26],
    /// One bit for each letter that has a number.
    present: u32,
    /// One bit for each letter that stands without a number.
    bare: u32,
}

impl Words {
    /// The number behind `letter`, in either case of it.
    #[inline]
    pub fn get(&self, letter: u8) -> Option<f64> {
        let index = index(letter)?;
        if self.present & (1 << index) == 0 {
            return None;
        }
        self.values.get(index).copied()
    }

    /// Whether `letter` has a number.
    #[inline]
    pub fn has(&self, letter: u8) -> bool {
        index(letter).is_some_and(|index| self.present & (1 << index) != 0)
    }

    /// Whether any of `letters` has a number.
    #[inline]
    pub fn has_any(&self, letters: &[u8]) -> bool {
        letters.iter().any(|&letter| self.has(letter))
    }

    /// Whether `letter` stands in the line without a number, as the axes do in `G28 X Y`.
    #[inline]
    pub fn is_bare(&self, letter: u8) -> bool {
        index(letter).is_some_and(|index| self.bare & (1 << index) != 0)
    }

    /// Whether any letter stands in the line without a number.
    #[inline]
    pub fn has_bare(&self) -> bool {
        self.bare != 0
    }

    /// The letters with their numbers, in the order of the alphabet.
    pub fn iter(&self) -> impl Iterator<Item = (u8, f64)> + '_ {
        (b'A'..=b'Z').filter_map(|letter| Some((letter, self.get(letter)?)))
    }

    /// One bit for each letter that has a number, A the lowest.
    #[inline]
    pub(crate) fn letters(&self) -> u32 {
        self.present
    }

    #[inline]
    pub(crate) fn clear(&mut self) {
        self.present = 0;
        self.bare = 0;
    }

    #[inline]
    pub(crate) fn put(&mut self, letter: u8, value: f64) {
        if let Some(index) = index(letter)
            && self.present & (1 << index) == 0
            && let Some(slot) = self.values.get_mut(index)
        {
            *slot = value;
            self.present |= 1 << index;
        }
    }

    /// Does as [`put`](Self::put), but of two words with one letter the last counts.
    pub(crate) fn replace(&mut self, letter: u8, value: f64) {
        if let Some(slot) = index(letter).and_then(|index| self.values.get_mut(index)) {
            *slot = value;
            self.put(letter, value);
        }
    }

    /// Does as [`put`](Self::put) with a `letter` in upper case that is not in `present`, a mask that the caller keeps
    /// for [`set_present`](Self::set_present). Returns the mask with it; nothing if the letter is in it.
    #[inline(always)]
    pub(crate) fn put_new(&mut self, present: u32, letter: u8, value: f64) -> Option<u32> {
        let index = letter.wrapping_sub(b'A') & 31;
        let bit = 1 << index;
        if present & bit != 0 {
            return None;
        }
        *self.values.get_mut(usize::from(index))? = value;
        Some(present | bit)
    }

    #[inline(always)]
    pub(crate) fn set_present(&mut self, present: u32) {
        self.present = present;
    }

    #[inline]
    pub(crate) fn put_bare(&mut self, letter: u8) {
        if let Some(index) = index(letter) {
            self.bare |= 1 << index;
        }
    }
}

/// Numbers of words that are not there do not count: they are left over from an earlier line.
impl PartialEq for Words {
    fn eq(&self, other: &Self) -> bool {
        self.present == other.present && self.bare == other.bare && self.iter().eq(other.iter())
    }
}

#[inline(always)]
fn index(letter: u8) -> Option<usize> {
    let index = (letter | 0x20).wrapping_sub(b'a');
    (index < 26).then_some(usize::from(index))
}
