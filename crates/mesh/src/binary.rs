use shape::{Point3, TriangleMesh};

/// The mesh as a binary STL, in millimetres.
///
/// A coordinate is written as the float nearest to its microns, which reads back as the same microns up to 16 m from the
/// origin.
pub fn binary_stl(mesh: &TriangleMesh, name: &str) -> Vec<u8> {
    const HEAD: usize = 80;
    let mut bytes = Vec::with_capacity(HEAD + 4 + mesh.faces.len() * 50);
    // Some readers take a header that starts with `solid` for text.
    bytes.extend(format!("clayforge mesh: {name}").bytes().take(HEAD));
    bytes.resize(HEAD, b' ');
    bytes.extend_from_slice(&(mesh.faces.len() as u32).to_le_bytes());
    let mm = |micron: i32| (f64::from(micron) / 1000.0) as f32;
    for face in &mesh.faces {
        let normal = mesh.normal(face);
        let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        let corners = mesh.corners(face).map(|Point3 { x, y, z }| [mm(x), mm(y), mm(z)]);
        for number in normal.map(|part| (part / length) as f32).iter().chain(corners.as_flattened()) {
            bytes.extend_from_slice(&number.to_le_bytes());
        }
        bytes.extend_from_slice(&[0; 2]);
    }
    bytes
}
