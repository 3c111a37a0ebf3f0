//! The variables of a program.

use std::collections::HashMap;

/// What `#1` to `#33` are in a call, and named variables of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Locals {
    numbered: HashMap<u32, f64>,
    named: HashMap<Vec<u8>, f64>,
}

/// All variables there are.
#[derive(Clone, Debug)]
pub(super) struct Store {
    /// The last number that is local to a call; 0 if none is.
    last_local: u32,
    global: Locals,
    /// One for each call, the program itself first.
    calls: Vec<Locals>,
    count: usize,
    limit: usize,
    /// Grows whenever a value changes.
    pub changes: u64,
}

impl Store {
    pub fn new(last_local: u32, limit: usize) -> Self {
        Self {
            last_local,
            global: Locals::default(),
            calls: vec![Locals::default()],
            count: 0,
            limit,
            changes: 0,
        }
    }

    /// How deep in calls it is.
    pub fn depth(&self) -> usize {
        self.calls.len() - 1
    }

    /// Begins a call with these arguments.
    pub fn enter(&mut self, arguments: impl Iterator<Item = (u32, f64)>) {
        let numbered: HashMap<u32, f64> = arguments.collect();
        self.count += numbered.len();
        self.changes += 1;
        self.calls.push(Locals { numbered, named: HashMap::new() });
    }

    /// Ends a call; the program itself goes on.
    pub fn leave(&mut self) {
        if self.calls.len() > 1
            && let Some(locals) = self.calls.pop()
        {
            self.count -= locals.numbered.len() + locals.named.len();
        }
    }

    fn scope(&self, local: bool) -> &Locals {
        if local { self.calls.last().unwrap_or(&self.global) } else { &self.global }
    }

    fn scope_mut(&mut self, local: bool) -> &mut Locals {
        if local { self.calls.last_mut().unwrap_or(&mut self.global) } else { &mut self.global }
    }

    fn is_local(&self, number: u32) -> bool {
        (1..=self.last_local).contains(&number)
    }

    pub fn number(&self, number: u32) -> Option<f64> {
        self.scope(self.is_local(number)).numbered.get(&number).copied()
    }

    pub fn name(&self, name: &[u8]) -> Option<f64> {
        self.scope(!name.starts_with(b"_")).named.get(name).copied()
    }

    /// Sets a variable; false if there are too many.
    pub fn set_number(&mut self, number: u32, value: f64) -> bool {
        let local = self.is_local(number);
        let old = self.scope_mut(local).numbered.insert(number, value);
        self.changed(old, value)
    }

    /// Sets a variable; false if there are too many.
    pub fn set_name(&mut self, name: &[u8], value: f64) -> bool {
        let scope = self.scope_mut(!name.starts_with(b"_"));
        let old = scope.named.insert(name.to_vec(), value);
        self.changed(old, value)
    }

    fn changed(&mut self, old: Option<f64>, value: f64) -> bool {
        self.count += usize::from(old.is_none());
        self.changes += u64::from(old != Some(value));
        self.count <= self.limit
    }
}
