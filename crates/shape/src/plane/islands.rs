use super::Ring;

/// Each outside of a region with the holes in it, the outside first; smaller islands before larger ones.
pub fn islands(region: &[Ring]) -> Vec<Vec<Ring>> {
    let (outsides, holes): (Vec<&Ring>, Vec<&Ring>) = region.iter().partition(|ring| ring.area2() > 0);
    let mut islands: Vec<Vec<Ring>> = outsides.into_iter().map(|ring| vec![ring.clone()]).collect();
    islands.sort_by_key(|island| island[0].area2());
    let boxes: Vec<_> = islands.iter().map(|island| island[0].bounds().unwrap_or_default()).collect();
    for hole in holes {
        let Some(&inside) = hole.0.first() else { continue };
        let holds = |index: &usize| {
            let (low, high) = boxes[*index];
            (low.x..=high.x).contains(&inside.x)
                && (low.y..=high.y).contains(&inside.y)
                && islands[*index][0].contains(inside)
        };
        // Smaller first, so the first that holds it is the innermost.
        if let Some(index) = (0..islands.len()).find(holds) {
            islands[index].push(hole.clone());
        }
    }
    islands
}
