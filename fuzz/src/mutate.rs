//! One input made into another.

use crate::Random;

/// Texts that readers of numbers stumble over, whatever the format.
const NUMBERS: &[&str] = &[
    "0",
    "-0",
    "1",
    "-1",
    "0.0005",
    "1e9",
    "1e308",
    "-1e308",
    "1e-400",
    "nan",
    "inf",
    "2147483647",
    "-2147483648",
    "2147483.647",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "18446744073709551616",
    ".",
    "-",
    "1.2.3",
    "1,5",
    "0000000001",
    "99999999999999999999999999999999999999",
    "0.00000000000000000000000001",
];
/// Bytes that binary readers take for counts and floats: little-endian 0, 1, −1, the largest and NaN, infinite, huge.
const WORDS: &[[u8; 4]] = &[
    [0; 4],
    [1, 0, 0, 0],
    [255; 4],
    [255, 255, 255, 127],
    [0, 0, 0, 128],
    [0, 0, 192, 127],
    [0, 0, 128, 127],
    [255, 255, 127, 127],
];

/// Makes inputs of other inputs.
#[derive(Clone, Copy, Debug)]
pub struct Mutator {
    /// Words of the format.
    pub dictionary: &'static [&'static str],
    /// No input is longer, in bytes.
    pub most: usize,
}

impl Mutator {
    /// An input made of one by a few changes; `other` is what pieces are taken from.
    pub fn mutated(&self, input: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
        let mut bytes = input.to_vec();
        for _ in 0..1 << random.below(5) {
            self.change(&mut bytes, other, random);
        }
        bytes.truncate(self.most);
        bytes
    }

    fn change(&self, bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
        let place = random.below(bytes.len() + 1);
        match random.below(12) {
            0 => overwrite(bytes, place, &[random.byte()]),
            1 => {
                if let Some(byte) = bytes.get_mut(place) {
                    *byte ^= 1 << random.below(8);
                }
            }
            2 => insert(bytes, place, &[random.byte()]),
            3 => {
                let end = (place + length(random)).min(bytes.len());
                bytes.drain(place..end);
            }
            4 => bytes.truncate(place),
            5 => {
                let piece = slice(bytes, random).to_vec();
                insert(bytes, place, &piece);
            }
            6 => insert(bytes, place, slice(other, random)),
            7 => overwrite(bytes, place, slice(other, random)),
            8 => number(bytes, place, random),
            9 => overwrite(bytes, place, random.one_of(WORDS).map_or(&[], |word| &word[..])),
            10 => swap_lines(bytes, random),
            _ => insert(bytes, place, random.one_of(self.dictionary).map_or(&[], |word| word.as_bytes())),
        }
    }
}

fn insert(bytes: &mut Vec<u8>, place: usize, piece: &[u8]) {
    bytes.splice(place..place, piece.iter().copied());
}

fn overwrite(bytes: &mut Vec<u8>, place: usize, piece: &[u8]) {
    let end = (place + piece.len()).min(bytes.len());
    bytes.splice(place..end, piece.iter().copied());
}

/// A length of up to a few hundred; short ones are likelier.
fn length(random: &mut Random) -> usize {
    let most = 1 << random.below(10);
    1 + random.below(most)
}

fn slice<'a>(bytes: &'a [u8], random: &mut Random) -> &'a [u8] {
    let from = random.below(bytes.len() + 1);
    &bytes[from..(from + length(random)).min(bytes.len())]
}

/// Puts another number in the place of the next one.
fn number(bytes: &mut Vec<u8>, place: usize, random: &mut Random) {
    let digit = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-');
    let Some(start) = bytes[place..].iter().position(digit).map(|found| place + found) else { return };
    let end = bytes[start..].iter().position(|byte| !digit(byte)).map_or(bytes.len(), |found| start + found);
    let made = random.below(100_000).to_string();
    let text =
        random.one_of(NUMBERS).filter(|_| random.clone().below(3) > 0).map_or(made.as_str(), |text| text);
    bytes.splice(start..end, text.bytes());
}

/// Moves a line to another place.
fn swap_lines(bytes: &mut Vec<u8>, random: &mut Random) {
    let mut lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
    if lines.is_empty() {
        return;
    }
    let (one, other) = (random.below(lines.len()), random.below(lines.len()));
    lines.swap(one, other);
    *bytes = lines.concat();
}
