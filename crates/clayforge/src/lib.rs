//! The facade: table of stages, pipeline, profiles, drawing.
