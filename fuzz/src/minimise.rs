//! A finding made small.

/// As many tries as are made; each runs the target once.
const TRIES: usize = 4000;

/// The smallest input for which `fails` still holds that is found by leaving pieces out, halves first.
pub fn minimised(input: &[u8], mut fails: impl FnMut(&[u8]) -> bool) -> Vec<u8> {
    let mut bytes = input.to_vec();
    let mut tries = 0;
    let mut length = bytes.len() / 2;
    while length > 0 {
        let (mut place, before) = (0, bytes.len());
        while place < bytes.len() && tries < TRIES {
            let end = (place + length).min(bytes.len());
            let without = [&bytes[..place], &bytes[end..]].concat();
            tries += 1;
            if fails(&without) {
                bytes = without;
            } else {
                place = end;
            }
        }
        if tries >= TRIES {
            break;
        }
        // What could not go before may go now.
        if bytes.len() == before || length > bytes.len() {
            length /= 2;
        }
    }
    bytes
}
