//! Benchmarks: import, carve, offset, fill, codec, whole slice.
