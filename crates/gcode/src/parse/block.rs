//! What stands on one line, before anybody says what it means.

use crate::word::Words;

/// The bit of a letter in the masks of [`Words`].
pub(super) const fn bit(letter: u8) -> u32 {
    1 << (letter - b'A')
}

/// The bits of several letters.
pub(super) const fn bits(letters: &[u8]) -> u32 {
    let mut mask = 0;
    let mut index = 0;
    while index < letters.len() {
        mask |= bit(letters[index]);
        index += 1;
    }
    mask
}

/// A G or M word.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CodeWord {
    /// In upper case.
    pub letter: u8,
    /// The number in tenths.
    pub tenths: u16,
    /// Behind the word.
    pub end: usize,
}

/// A list of a few things, without allocation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Few<T, const N: usize> {
    items: [T; N],
    length: usize,
}

impl<T: Copy + Default, const N: usize> Few<T, N> {
    /// Whether there was room for it.
    pub fn push(&mut self, item: T) -> bool {
        let slot = self.items.get_mut(self.length);
        let fits = slot.is_some();
        if let Some(slot) = slot {
            *slot = item;
            self.length += 1;
        }
        fits
    }

    pub fn as_slice(&self) -> &[T] {
        self.items.get(..self.length).unwrap_or_default()
    }

    pub fn as_mut_slice(&mut self) -> &mut [T] {
        self.items.get_mut(..self.length).unwrap_or_default()
    }
}

impl<T: Copy + Default, const N: usize> Default for Few<T, N> {
    fn default() -> Self {
        Self { items: [T::default(); N], length: 0 }
    }
}

/// The words of a line.
#[derive(Clone, Debug, Default)]
pub(super) struct Block<'a> {
    /// From the first word to the end of the last.
    pub code: &'a [u8],
    /// Where `code` begins in the line.
    pub start: usize,
    /// All words but G and M.
    pub words: Words,
    /// The G and M words.
    pub codes: Few<CodeWord, 12>,
    /// Letters without a number, with their columns; of `nan` only the first.
    pub bare: Few<(u8, usize), 8>,
    /// The remarks, without the marks around them.
    pub remarks: Few<&'a [u8], 8>,
    /// Words of a name that nobody knows.
    pub names: Few<&'a [u8], 4>,
    /// The radius of an arc, where that is a name.
    pub radius: Option<f64>,
    /// The section of the bead from here on.
    pub bead: Option<f64>,
    /// Siemens' word for the coordinates of the machine.
    pub machine: bool,
    /// Whether the line is not to be obeyed.
    pub refused: bool,
    /// A code of which the rest of the line is the text.
    pub text: Option<(CodeWord, &'a [u8])>,
}
