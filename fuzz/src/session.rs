//! A target under fire.

use crate::{Mutator, Random, Target};
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// An input that broke something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The bytes.
    pub input: Vec<u8>,
    /// What the panic said.
    pub message: String,
}

/// Runs a target on one input: what it says, or what its panic says.
///
/// # Errors
/// The message of the panic.
pub fn attempt(target: &Target, input: &[u8]) -> Result<String, String> {
    catch_unwind(AssertUnwindSafe(|| (target.run)(input))).map_err(|cause| {
        let text = cause.downcast_ref::<String>().map(String::as_str);
        text.or_else(|| cause.downcast_ref::<&str>().copied()).unwrap_or("a panic without a word").to_owned()
    })
}

/// What is kept of a run: what comes next follows from it.
pub struct Session {
    target: &'static Target,
    random: Random,
    pool: Vec<Vec<u8>>,
    seen: BTreeSet<String>,
}

impl Session {
    /// Starts from seeds, or from nothing.
    pub fn new(target: &'static Target, seeds: Vec<Vec<u8>>, seed: u64) -> Self {
        let pool = if seeds.is_empty() { vec![Vec::new()] } else { seeds };
        Self { target, random: Random::new(seed), pool, seen: BTreeSet::new() }
    }

    /// How many inputs are kept, and how many different things they came to.
    pub fn size(&self) -> (usize, usize) {
        (self.pool.len(), self.seen.len())
    }

    /// The seeds that break something as they are.
    pub fn replay(&mut self, mut before: impl FnMut(&[u8])) -> Vec<Finding> {
        let mut findings = Vec::new();
        for input in self.pool.clone() {
            before(&input);
            findings.extend(self.judge(input, false));
        }
        findings
    }

    /// Makes an input, shows it to `before` and gives it to the target; what is new about it is said once.
    pub fn step(&mut self, before: impl FnOnce(&[u8])) -> Option<Finding> {
        let Self { target, random, pool, .. } = self;
        let input = random.below(pool.len());
        let other = random.below(pool.len());
        let mutator = Mutator { dictionary: target.dictionary, most: target.most };
        let made = mutator.mutated(&pool[input], &pool[other], random);
        before(&made);
        self.judge(made, true)
    }

    fn judge(&mut self, input: Vec<u8>, keep: bool) -> Option<Finding> {
        match attempt(self.target, &input) {
            Ok(said) => {
                if self.seen.insert(kind(&said)) && keep {
                    self.pool.push(input);
                }
                None
            }
            Err(message) => self.seen.insert(kind(&message)).then_some(Finding { input, message }),
        }
    }
}

/// What is said without its numbers and quotations: inputs of one kind are alike.
fn kind(said: &str) -> String {
    let mut quoted = false;
    let plain = said.chars().filter(|&letter| {
        quoted ^= matches!(letter, '`' | '"');
        !quoted && !letter.is_ascii_digit()
    });
    plain.take(300).collect()
}
