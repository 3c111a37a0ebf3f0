//! Parts made up on the way.

/// The corners of a facet, in millimetres.
pub type Triangle = [[f64; 3]; 3];

/// The triangles as a binary STL. Normals are left out, since every reader knows better.
pub fn stl(triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend_from_slice(&(triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend_from_slice(&[0; 12]);
        for number in triangle.iter().flatten() {
            bytes.extend_from_slice(&(*number as f32).to_le_bytes());
        }
        bytes.extend_from_slice(&[0; 2]);
    }
    bytes
}
