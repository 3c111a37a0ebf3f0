//! Files: older ones stay, links, devices, pipes, and a full disk.

use crate::command::{Ran, Room, assert_message, program};
use crate::support::{cuboid, example, stl, text_of};
use std::fs;
use std::io::Read;
use std::process::{Command, Stdio};

#[test]
fn an_older_file_stays_when_a_slice_fails() {
    let room = Room::new();
    let mut broken = stl(&cuboid([0.0; 3], [20.0, 20.0, 10.0]));
    broken.truncate(500);
    room.put("part.stl", broken).put("part.gcode", "G28 ; yesterday's\n");
    let before = room.listing();
    assert_eq!(room.run(&["slice", "part.stl"]).code, Some(1));
    assert_eq!(room.listing(), before);
    room.put("part.stl", example("cube"));
    let before = room.listing();
    // It fails in the last stage, when the file is begun already.
    assert_eq!(room.run(&["slice", "part.stl", "--set", "alteration.end=M109 S200"]).code, Some(1));
    assert_eq!(room.listing(), before);
    room.run(&["slice", "part.stl"]).done();
    assert_ne!(room.listing(), before);
}

#[test]
fn the_part_is_never_written_over() {
    let room = Room::new();
    room.put("cube.stl", example("cube"));
    let before = room.listing();
    let ran = room.run(&["slice", "cube.stl", "-o", "cube.stl"]);
    assert_eq!(ran.code, Some(1));
    assert_message(&ran.err, &["cube.stl", "the part"]);
    assert_eq!(room.listing(), before);
}

/// A link means the file that it leads to, and a device cannot be replaced.
#[cfg(unix)]
#[test]
fn a_link_is_written_through_and_a_device_straight() {
    let room = Room::new();
    room.put("cube.stl", example("cube")).put("target.gcode", "yesterday's\n");
    std::os::unix::fs::symlink("target.gcode", room.path("link.gcode")).expect("a link");
    room.run(&["slice", "cube.stl", "-o", "link.gcode"]).done();
    assert!(fs::symlink_metadata(room.path("link.gcode")).expect("it is there").is_symlink());
    assert!(text_of(&room.path("target.gcode")).contains("G1 "));
    room.run(&["slice", "cube.stl", "-o", "/dev/null"]).done();
    assert_eq!(room.listing().len(), 3);
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let room = Room::new();
    room.put("vase.stl", example("vase"));
    for words in
        [&["slice", "vase.stl", "-o", "-", "--quiet"][..], &["profile", "schema"], &["explain", "export"]]
    {
        let mut child = room
            .command(words)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command runs");
        let mut out = child.stdout.take().expect("piped");
        let mut first = [0; 1];
        out.read_exact(&mut first).expect("it says something");
        drop(out);
        let ran: Ran = child.wait_with_output().expect("it ends").into();
        assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""), "{words:?}");
    }
}

/// Promise 9: a disk that is full is an error, and the target is as it was.
#[cfg(unix)]
#[test]
fn a_full_disk_is_an_error_and_nothing_is_left() {
    let room = Room::new();
    room.put("vase.stl", example("vase")).put("vase.gcode", "yesterday's\n");
    let before = room.listing();
    let program = program().display();
    let output = Command::new("sh")
        .args(["-c", &format!("ulimit -f 8 && exec '{program}' slice vase.stl")])
        .current_dir(room.path(""))
        .output()
        .expect("sh runs");
    let ran: Ran = output.into();
    assert_eq!(ran.code, Some(1), "{}", ran.err);
    assert_message(&ran.err, &["vase.gcode", "no room"]);
    assert_eq!(room.listing(), before);
}

/// Promise 10: Ctrl-C leaves nothing.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing() {
    let room = Room::new();
    room.put("vase.stl", example("vase"));
    let before = room.listing();
    let fine = [
        "--set",
        "carve.layer_height=0.05",
        "--set",
        "carve.first_layer_height=0.05",
        "--set",
        "fill.density=1",
    ];
    let words: Vec<&str> =
        ["slice", "vase.stl", "--set", "carve.bead_width=0.3"].into_iter().chain(fine).collect();
    let mut child =
        room.command(&words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it runs");
    let begun = std::time::Instant::now();
    // Its unfinished file shows that it is at work.
    while room.listing().len() == before.len() && begun.elapsed().as_secs() < 20 {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert!(
        child.try_wait().expect("it can be asked").is_none(),
        "it was done before it could be interrupted"
    );
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(kill.success());
    let status = child.wait().expect("it ends");
    assert!(!status.success(), "{status}");
    assert_eq!(room.listing().keys().collect::<Vec<_>>(), before.keys().collect::<Vec<_>>());
}
