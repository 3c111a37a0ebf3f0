use super::outline::Trouble;
use super::path;
use crate::{ErrorKind, FileUnit, Import, ImportError};
use proptest::prelude::*;
use shape::Ring;

type Loops = Vec<Vec<(f64, f64)>>;

fn drawing(text: &str) -> Result<crate::Drawing, ImportError> {
    Import::default().drawing(text.as_bytes())
}

/// Heights and loops in millimetres, each loop from its least point, larger ones first.
fn layers(text: &str) -> Vec<(f64, Loops)> {
    let drawing = drawing(text).expect("a drawing");
    let layers = drawing.slices.layers.into_iter();
    layers
        .map(|layer| {
            let mut loops = layer.loops;
            loops.sort_by_key(|ring| std::cmp::Reverse(ring.area2().unsigned_abs()));
            (layer.z.mm(), loops.into_iter().map(from_least).collect())
        })
        .collect()
}

/// The part that stages.md §1 draws in both forms: a plate with a hole, and a whole one upon it.
fn assert_is_the_part_of_the_specification(text: &str) {
    let outer = vec![(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)];
    let hole = vec![(3.0, 3.0), (3.0, 5.0), (5.0, 5.0), (5.0, 3.0)];
    assert_eq!(layers(text), [(0.5, vec![outer.clone(), hole]), (1.5, vec![outer])]);
    let facts = drawing(text).expect("a drawing").slices.facts;
    assert_eq!(facts.layer_height.map(|height| height.mm()), Some(1.0));
    assert_eq!(facts.bead_width.map(|width| width.mm()), Some(2.0));
}

fn from_least(mut ring: Ring) -> Vec<(f64, f64)> {
    let least = (0..ring.0.len()).min_by_key(|index| ring.0[*index]).unwrap_or(0);
    ring.0.rotate_left(least);
    ring.0.iter().map(|point| (f64::from(point.x) / 1000.0, f64::from(point.y) / 1000.0)).collect()
}

/// The only layer of a drawing with this inside.
fn loops(inside: &str) -> Loops {
    let text =
        format!("<svg width='100mm' height='100mm' viewBox='0 0 100 100'><g id='z:1'>{inside}</g></svg>");
    layers(&text).remove(0).1
}

/// Its area in mm², holes taken off.
fn area(inside: &str) -> f64 {
    let text =
        format!("<svg width='100mm' height='100mm' viewBox='0 0 100 100'><g id='z:1'>{inside}</g></svg>");
    let drawing = drawing(&text).expect("a drawing");
    drawing.slices.layers[0].loops.iter().map(Ring::area).sum()
}

fn remarks(text: &str) -> String {
    drawing(text).expect("a drawing").remarks.join("\n")
}

fn refused(text: &str) -> ImportError {
    drawing(text).expect_err("no drawing")
}

const SQUARE: &[(f64, f64)] = &[(10.0, 80.0), (20.0, 80.0), (20.0, 90.0), (10.0, 90.0)];

/// The example of stages.md §1.3.
#[test]
fn plain_coordinates_are_taken_as_they_are() {
    let text = r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:slice="urn:example:slice" version="1.1">
 <metadata><slice:layers layerHeight="1.0" edgeWidth="2.0" decimalPlacesCarried="3"
   procedureName="carve" minX="0.0" maxX="8.0" minY="0.0" maxY="8.0" minZ="0.0" maxZ="2.0"
   yAxisPointingUpward="true"/></metadata>
 <g id="z:0.5" transform="translate(20,60)"><path transform="scale(3.7,-3.7)"
   d="M 0.0 0.0 L 8.0 0.0 L 8.0 8.0 L 0.0 8.0 z M 3.0 3.0 L 3.0 5.0 L 5.0 5.0 L 5.0 3.0 z"/></g>
 <g id="z:1.5"><path d="M 0.0 0.0 L 8.0 0.0 L 8.0 8.0 L 0.0 8.0 z"/></g>
 <g beginningOfControlSection="true"><g id="z:9"><rect width="1" height="1"/></g></g>
 <g id="z:9"><rect width="1" height="1"/></g>
</svg>"#;
    // In the example nothing is transformed for viewers, and nothing follows the layers: both make no difference.
    assert_is_the_part_of_the_specification(text);
}

/// The older form, stages.md §1.2: what is said of the part stands in a script, and a layer with a bridge has a comment.
#[test]
fn the_drawing_of_the_seed_has_plain_coordinates_too() {
    let text = r#"<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" version="1.1" width="600px" height="400px">
 <script type="text/ecmascript">
<![CDATA[
	decimalPlacesCarried = 3
	layerThickness = 1.0
	perimeterWidth = 2.0
	procedureDone = "carve"
	extrusionStart = 1
]]>
 </script>
 <g id="z 0.5" transform="translate(20, 242)">
  <text y="15" fill="black" stroke="none">Layer 0, z 0.5</text>
  <path transform="scale(3.7, -3.7) translate(0, 0)" fill="white" fill-rule="evenodd"
   d="M 0.0 0.0 L 8.0 0.0 L 8.0 8.0 L 0.0 8.0 z M 3.0 3.0 L 3.0 5.0 L 5.0 5.0 L 5.0 3.0 z"/>
 </g>
 <g id="z 1.5" transform="translate(120, 242)">
  <text y="15" fill="black" stroke="none">Layer 1, z 1.5</text>
  <!-- <bridgeRotation> (0.6+0.8j) </bridgeRotation> -->
  <path transform="scale(3.7, -3.7) translate(0, 0)" d="M 0.0 0.0 L 8.0 0.0 L 8.0 8.0 L 0.0 8.0 z"/>
 </g>
</svg>"#;
    assert_is_the_part_of_the_specification(text);
    assert_eq!(remarks(text), "");
    // A script that knows nothing of layers leaves a drawing what it is.
    assert_ne!(layers(&text.replace("layerThickness", "zoom")), layers(text));
}

/// As Slic3r writes it: heights a million times too small, y upwards, holes painted over, and a DOCTYPE.
#[test]
fn polygons_that_say_what_they_are() {
    let text = r#"<?xml version="1.0"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.0//EN" "http://www.w3.org/TR/2001/REC-SVG-20010904/DTD/svg10.dtd">
<svg width="8" height="8" xmlns="http://www.w3.org/2000/svg" xmlns:slic3r="http://slic3r.org/namespaces/slic3r">
 <g id="layer0" slic3r:z="6e-07">
  <polygon slic3r:type="contour" points="8,2 8,8 0,0" style="fill: white"/>
  <polygon slic3r:type="hole" points="6,3 6,4 5,4" style="fill: black"/>
  <polygon slic3r:type="contour" points="5.5,3.75 5.75,3.5 5.75,3.75" style="fill: white"/>
 </g>
 <g id="layer1" slic3r:z="1.7e-06"/>
</svg>"#;
    let read = layers(text);
    assert_eq!((read[0].0, read[1].0, read[1].1.len()), (0.6, 1.7, 0));
    assert_eq!(read[0].1[0], [(0.0, 0.0), (8.0, 2.0), (8.0, 8.0)]);
    assert!(drawing(text).expect("a drawing").remarks.is_empty());
    // Old ones have true heights.
    let old = text.replace("6e-07", "0.6").replace("1.7e-06", "1.7");
    assert_eq!((layers(&old)[0].0, layers(&old)[1].0), (0.6, 1.7));
}

#[test]
fn heights_stand_in_many_places() {
    for (group, z) in [
        ("<g id='z:1.5'>", 1.5),
        ("<g id='layer7' inkscape:label='Layer 3, z:1.5'>", 1.5),
        ("<g id='a' label='z 2'>", 2.0),
        ("<g id='b' data-name='z:0.5'>", 0.5),
        ("<g z='3.25'>", 3.25),
        ("<g inkscape:z='-0.5'>", -0.5),
        ("<g id='z:9' z='4'>", 4.0),
    ] {
        let text = format!("<svg xmlns:inkscape='urn:i'>{group}<rect width='1' height='1'/></g></svg>");
        assert_eq!(layers(&text)[0].0, z, "{group}");
    }
}

#[test]
fn a_page_says_its_unit() {
    let rect = "<g z='1'><rect width='1' height='1'/></g>";
    for (page, x, y) in [
        ("", 1.0, 1.0),
        ("width='50' height='50'", 1.0, 1.0),
        ("width='50px' height='50px'", 0.265, 0.265),
        ("width='50mm' height='50mm' viewBox='0 0 25 25'", 2.0, 2.0),
        ("width='1in' viewBox='0 0 10 10'", 2.54, 2.54),
        ("height='10cm' viewBox='0 0 1 10'", 10.0, 10.0),
        ("width='20mm' height='50mm' viewBox='0 0 10 10'", 2.0, 2.0),
        ("width='20mm' height='50mm' viewBox='0 0 10 10' preserveAspectRatio='none'", 2.0, 5.0),
        ("width='72pt' height='72pt' viewBox='0 0 1 1'", 25.4, 25.4),
        ("width='100%' viewBox='0 0 9 9'", 1.0, 1.0),
    ] {
        let read = layers(&format!("<svg {page}>{rect}</svg>"));
        let corners = &read[0].1[0];
        let (low, high) = (corners[0], corners[2]);
        // A side that was no whole number of microns is rounded at both its ends.
        let is_near = |side: f64, wanted: f64| (side - wanted).abs() < 0.0011;
        assert!(is_near(high.0 - low.0, x) && is_near(high.1 - low.1, y), "{page}: {corners:?}");
    }
    assert!(remarks(&format!("<svg>{rect}</svg>")).contains("no unit"));
    let inches = Import { unit: FileUnit::Inch };
    let read = inches.drawing(format!("<svg>{rect}</svg>").as_bytes()).expect("a drawing");
    assert_eq!((read.slices.bounds.max.x, read.slices.layers[0].z.0), (25_400, 25_400));
}

#[test]
fn y_goes_up_from_the_lower_edge_of_the_page() {
    assert_eq!(loops("<rect x='10' y='10' width='10' height='10'/>"), [SQUARE]);
}

#[test]
fn shapes_of_every_kind() {
    let square = [SQUARE.to_vec()];
    for shape in [
        "<path d='M10 10h10v10h-10z'/>",
        "<path d='M10,10 20,10 20,20 10,20'/>",
        "<path d='m10 10l10 0 0 10-10 0z'/>",
        "<polygon points='10,10 20,10 20,20 10,20'/>",
        "<polyline points='10 10 20 10 20 20 10 20'/>",
        "<line x1='10' y1='15' x2='20' y2='15' stroke='red' stroke-width='10'/>",
        "<g transform='translate(10 10)'><rect width='1' height='1' transform='scale(10)'/></g>",
        "<rect width='10' height='10' transform='rotate(90) translate(10, -20)'/>",
        "<defs><rect id='r' width='10' height='10'/></defs><use href='#r' x='10' y='10'/>",
        "<defs><symbol id='s' viewBox='0 0 1 1'><rect width='1' height='1'/></symbol></defs>\
         <use xmlns:x='http://www.w3.org/1999/xlink' x:href='#s' transform='translate(10,10) scale(10)'/>",
        "<svg x='10' y='10' width='10' height='10' viewBox='5 5 2 2'><rect x='5' y='5' width='2' height='2'/></svg>",
        "<rect x='10%' y='10%' width='10%' height='10%'/>",
    ] {
        assert_eq!(loops(shape), square, "{shape}");
    }
}

#[test]
fn curves_are_followed_within_some_microns() {
    use std::f64::consts::PI;
    // Twenty millimetres of radius; a chord that is missed by 2 µm at most takes less than a thousandth of the area.
    let circle = 400.0 * PI;
    for (shape, wanted) in [
        ("<circle cx='50' cy='50' r='20'/>", circle),
        ("<ellipse cx='50' cy='50' rx='40' ry='10'/>", circle),
        ("<path d='M30 50a20 20 0 1 0 40 0a20 20 0 1 0-40 0'/>", circle),
        ("<path d='M30,50A20,20 0 0120,60'/>", 0.0),
        ("<rect x='10' y='10' width='40' height='40' rx='20'/>", circle),
        ("<rect x='10' y='10' width='40' height='30' rx='5'/>", 1200.0 - 25.0 * (4.0 - PI)),
        ("<circle r='1' transform='translate(50,50) scale(20)'/>", circle),
        // Two thirds of the rectangle around a parabola, and three fifths around this cubic.
        ("<path d='M10 50Q30 10 50 50z'/>", 40.0 * 20.0 * 2.0 / 3.0),
        ("<path d='M10 50C10 10 50 10 50 50z'/>", 40.0 * 40.0 * 0.6),
        ("<path d='M10 50Q20 40 30 50T50 50'/>", 2.0 * 20.0 * 5.0 * 2.0 / 3.0),
    ] {
        let found = area(shape);
        assert!(wanted == 0.0 || (found - wanted).abs() < wanted * 0.001, "{shape}: {found}, not {wanted}");
    }
    let ways = path::ways("M1 0A1 1 0 0 1-1 0", 0.0001).expect("an arc");
    for pair in ways[0].points.windows(2) {
        let middle = libm::hypot((pair[0].0 + pair[1].0) / 2.0, (pair[0].1 + pair[1].1) / 2.0);
        assert!(1.0 - middle <= 0.000_100_1, "{pair:?}");
    }
    assert_eq!(path::ways("M0 0L", 1.0), Err(Trouble::Damaged));
}

#[test]
fn holes_go_by_the_rule_of_the_fill() {
    let twice = "d='M10 10h10v10h-10zM12 12h4v4h-4z'";
    assert!((area(&format!("<path {twice}/>")) - 100.0).abs() < 1e-9);
    assert!((area(&format!("<path {twice} fill-rule='evenodd'/>")) - 84.0).abs() < 1e-9);
    assert!((area(&format!("<g style='fill-rule:evenodd'><path {twice}/></g>")) - 84.0).abs() < 1e-9);
    let turned = "<path d='M10 10h10v10h-10zM12 12v4h4v-4z'/>";
    assert_eq!(loops(turned).len(), 2);
}

#[test]
fn shapes_within_shapes_are_holes_and_shapes_that_cross_are_one() {
    let square = |x: i32, side: i32| format!("<rect x='{x}' y='{x}' width='{side}' height='{side}'/>");
    let area = |shapes: &[String]| area(&shapes.concat());
    assert_eq!(area(&[square(10, 30), square(15, 20), square(20, 10)]), 900.0 - 400.0 + 100.0);
    assert_eq!(area(&[square(20, 10), square(10, 30)]), 800.0);
    // The second crosses the first, the third lies in both.
    assert_eq!(area(&[square(10, 20), square(20, 20), square(22, 2)]), 400.0 + 400.0 - 100.0 - 4.0);
    // Drawn twice is drawn once.
    assert_eq!(area(&[square(10, 20), square(10, 20)]), 400.0);
}

#[test]
fn lines_without_a_fill_are_as_wide_as_their_stroke() {
    // A length with a unit is one of the page, before its window is scaled: 96 pixels are an inch.
    for (shape, wanted) in [
        ("<path d='M10 10h10' fill='none' stroke='#000' stroke-width='2'/>", 19.999..20.001),
        ("<path d='M10 10h10v10h-10z' style='fill:none;stroke:red;stroke-width:2'/>", 79.999..80.001),
        ("<g fill='none' stroke='red'><g transform='scale(2)'><path d='M5 5h10'/></g></g>", 39.999..40.001),
        (
            "<style>.a{fill:none} /* b */ path , #p { stroke:red; stroke-width:1mm }</style>\
          <path class='c a' d='M10 10h10'/>",
            37.79..37.81,
        ),
    ] {
        let found = area(shape);
        assert!(wanted.contains(&found), "{shape}: {found}");
    }
    // A right angle is mitred, a sharp one is cut off.
    assert_eq!(loops("<path d='M10 20v-10h10' fill='none' stroke='red' stroke-width='2'/>")[0].len(), 6);
    let sharp = loops("<path d='M10 10h10L10 12' fill='none' stroke='red' stroke-width='2'/>");
    assert!(sharp[0].iter().all(|(x, _)| *x < 21.1), "{sharp:?}");
    // A line that comes back to itself leaves the middle open.
    assert_eq!(loops("<circle cx='50' cy='50' r='20' fill='none' stroke='red'/>").len(), 2);
}

#[test]
fn what_is_left_out_is_said() {
    let text = "<svg width='9mm'><rect width='1' height='1'/><g z='1'><rect width='1' height='1'/><text>hi</text>\
        <image/><g display='none'><rect/></g><path d='M0 0h1'/><video/></g><g z='2' display='none'>\
        <rect width='1' height='1'/></g></svg>";
    let said = remarks(text);
    for word in
        ["1 texts", "1 images", "1 hidden", "1 shapes with neither", "1 shapes stand in no", "1 elements"]
    {
        assert!(said.contains(word), "{word}: {said}");
    }
    // Nobody prints a pot without the layers that were switched off to look at others.
    assert_eq!(layers(text)[1].1.len(), 1);
}

#[test]
fn heights_are_sorted_and_equal_ones_are_one_layer() {
    let group = |z: i32, x: i32| format!("<g z='{z}'><rect x='{x}' width='1' height='1'/></g>");
    let text = format!("<svg width='9mm'>{}{}{}<g z='3'/></svg>", group(2, 0), group(1, 0), group(2, 5));
    let found: Vec<(f64, usize)> = layers(&text).iter().map(|(z, loops)| (*z, loops.len())).collect();
    assert_eq!(found, [(1.0, 1), (2.0, 2), (3.0, 0)]);
    assert!(remarks(&text).contains("sorted"));
}

#[test]
fn what_is_refused() {
    let layer = |inside: &str| format!("<svg width='9mm'>\n<g z='1'>{inside}</g></svg>");
    for (text, kind) in [
        ("<svg><g id='a'><rect width='1' height='1'/></g></svg>".to_owned(), ErrorKind::NoHeight),
        ("<svg/>".to_owned(), ErrorKind::NoHeight),
        (layer(""), ErrorKind::NoFacets),
        (layer("<path d='M0 0 L1 x'/>"), ErrorKind::Syntax),
        (layer("<polygon points='0,0 1,0 b'/>"), ErrorKind::Syntax),
        (layer("<rect width='1' height='a'/>"), ErrorKind::Syntax),
        (layer("<g transform='turn(1)'><path/></g>"), ErrorKind::Syntax),
        (layer("<path d='M0 0h1e9v1z'/>"), ErrorKind::TooFar),
        (layer("<path d='M0 0C1e300 1e300-1e300 1 0 1'/>"), ErrorKind::TooFar),
        (layer("<path d='M0 0h1e40v1e40z' transform='scale(1e300)'/>"), ErrorKind::TooFar),
        ("<svg><g z='1e12'><rect width='1' height='1'/></g></svg>".to_owned(), ErrorKind::TooFar),
        (layer("<use href='#nowhere'/>"), ErrorKind::Missing),
        (layer("<use href='other.svg#a'/>"), ErrorKind::Missing),
        (layer("<g id='a'><use href='#a'/></g>"), ErrorKind::TooLarge),
        (layer(&format!("{}{}", "<g>".repeat(5000), "</g>".repeat(5000))), ErrorKind::TooLarge),
        (layer("<path"), ErrorKind::Syntax),
        ("<!DOCTYPE a [<!ENTITY b 'x'><!ENTITY c '&b;&b;'>]><svg>&c;</svg>".to_owned(), ErrorKind::TooLarge),
        (
            "<!DOCTYPE a [<!ENTITY b SYSTEM 'file:///etc/passwd'>]><svg>&b;</svg>".to_owned(),
            ErrorKind::Syntax,
        ),
    ] {
        let error = refused(&text);
        assert_eq!(error.kind, kind, "{text:.80}: {error}");
        assert!(!error.hint.is_empty());
    }
    assert_eq!(Import::default().drawing(b"<svg>\xff").expect_err("no text").kind, ErrorKind::Syntax);
    assert_eq!(
        refused(&layer("<path d='M0 0 L1 x'/>")).to_string(),
        "`M0 0 L1 x` cannot be read as the `d` of a `path` (line 2)"
    );
}

/// Every crossing becomes a corner, and a thousand chords cross a quarter of a million times.
#[test]
fn what_crosses_itself_too_often_is_refused() {
    let star = |corners: i64| {
        let corner = |n: i64| format!("{},{} ", n * 7919 % 1009, n * 104_729 % 1013);
        let points: String = (0..corners).map(corner).collect();
        format!("<svg width='9mm'><g z='1'><polygon points='{points}' fill-rule='evenodd'/></g></svg>")
    };
    assert!(drawing(&star(300)).is_ok());
    assert_eq!(refused(&star(20_000)).kind, ErrorKind::TooLarge);
    let round = "<svg width='9mm'><g z='1'><circle r='100000'/><circle r='90000'/></g></svg>";
    assert!(drawing(round).expect("a ring").slices.layers[0].loops[0].0.len() > 4000);
}

/// Each doubles the one before it: a kilobyte asks for a billion squares.
#[test]
fn copies_of_copies_end() {
    let doubled: String =
        (1..30).map(|n| format!("<g id='a{n}'><use href='#a{0}'/><use href='#a{0}'/></g>", n - 1)).collect();
    let text = format!(
        "<svg><defs><rect id='a0' width='1' height='1'/>{doubled}</defs><g z='1'><use href='#a29'/></g></svg>"
    );
    assert_eq!(refused(&text).kind, ErrorKind::TooLarge);
    let many = "&b;".repeat(400_000);
    let text = format!("<!DOCTYPE a [<!ENTITY b '{}'>]><svg id='{many}'/>", "x".repeat(250));
    assert_eq!(refused(&text).kind, ErrorKind::TooLarge);
}

#[test]
fn entities_of_one_word_are_read() {
    let text = "<!DOCTYPE svg [<!ENTITY ns_svg \"http://www.w3.org/2000/svg\">]>\
        <svg xmlns='&ns_svg;' width='9mm'><g id='z_x3A_1_x2E_5'><rect width='1' height='1'/></g></svg>";
    assert_eq!(layers(text)[0].0, 1.5);
}

proptest! {
    /// Wherever a shape is moved and however it is turned, it covers as much.
    #[test]
    fn a_transform_that_keeps_lengths_keeps_the_area(x in -500.0..500.0, y in -500.0..500.0, turn in -360.0..360.0) {
        let shape = "<path d='M10 10C20 0 30 20 40 10V30A15 10 0 0 1 10 30z'/>";
        let moved = format!("<g transform='translate({x},{y}) rotate({turn} 3 4)'>{shape}</g>");
        let (still, moved) = (area(shape), area(&moved));
        prop_assert!((still - moved).abs() < 0.5, "{still} {moved}");
    }

    /// Whatever stands in a path, it is a drawing or a refusal.
    #[test]
    fn any_path_is_read_or_refused(data in "[MmLlHhVvCcSsQqTtAaZz0-9eE.,+ -]{0,60}", rule in prop::bool::ANY) {
        let rule = if rule { "evenodd" } else { "nonzero" };
        let shape = format!("<path d='M0 0{data}' fill-rule='{rule}'/>");
        let stroke = shape.replace("fill-rule", "fill='none' stroke='red' fill-rule");
        for shape in [shape, stroke] {
            let _ = drawing(&format!("<svg><g z='1'>{shape}</g></svg>"));
        }
    }
}
