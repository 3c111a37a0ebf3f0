//! What is wrong with a part, and its repair.
//!
//! [`diagnose`] says everything that a potter wants to know of a mesh before it is printed. [`repair`] makes a mesh
//! whose layers close; it is asked for only when [`shape::solid::Flaws`], which the reader counts at no cost, says that
//! something is wrong. [`turned`] and [`arranged`] put parts on the bed.
//!
//! Nothing here moves a vertex to a place that the file does not have: cracks are closed by taking one of two vertices
//! for the other, T-junctions by splitting a triangle at a vertex that is there, holes by triangles between the
//! vertices of their rim. Nothing depends on the order of the triangles in the file but the order of the result.

mod binary;
mod crossings;
mod diagnosis;
mod holes;
mod orient;
mod overhang;
mod place;
mod repair;
mod rims;
mod shells;
mod split;
mod stand;
mod tree;
mod twins;
mod walls;
mod weld;

pub use binary::binary_stl;
pub use diagnosis::{Diagnosis, diagnose};
pub use overhang::Overhang;
pub use place::{NoRoom, Turn, arranged, joined, turned};
pub use repair::{Repair, Repairs, repair};
pub use stand::Stand;

#[cfg(test)]
mod tests;
