//! What goes wrong around the command: it is killed, the disk is full, the folder is closed to it, its reader leaves,
//! or it is asked for what would never end. A named file is then absent, or complete, or the old one.
#![cfg(unix)]

use crate::command::{Ran, Room};
use crate::support::{cuboid, example, stl};
use std::fs;
use std::io::Read;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Settings that make of a vase work for seconds.
const LONG: [&str; 8] = [
    "--set",
    "carve.layer_height=0.05",
    "--set",
    "carve.first_layer_height=0.05",
    "--set",
    "carve.bead_width=0.3",
    "--set",
    "fill.density=1",
];
/// No wait is longer; a test that comes here has failed.
const PATIENCE: Duration = Duration::from_secs(60);

/// A vase, and yesterday's file of it.
fn room() -> Room {
    let room = Room::new();
    room.put("vase.stl", example("vase")).put("vase.gcode", "yesterday's\n");
    room
}

/// The names of unfinished files.
fn unfinished(room: &Room) -> Vec<String> {
    let names = room.listing().into_keys();
    names.filter(|name| name != "vase.stl" && name != "vase.gcode").collect()
}

/// A slicing that is at work: its unfinished file is there.
fn at_work(room: &Room) -> Child {
    let words = [&["slice", "vase.stl"][..], &LONG].concat();
    let mut command = room.command(&words);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the command runs");
    let begun = Instant::now();
    while unfinished(room).is_empty() {
        assert!(child.try_wait().expect("it can be asked").is_none(), "it was done before it could be hit");
        assert!(begun.elapsed() < PATIENCE, "it does not begin");
        sleep(Duration::from_millis(2));
    }
    child
}

fn hit(child: &mut Child, signal: &str) -> ExitStatus {
    let kill = Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(kill.expect("kill runs").success());
    let begun = Instant::now();
    loop {
        if let Some(status) = child.try_wait().expect("it can be asked") {
            return status;
        }
        assert!(begun.elapsed() < PATIENCE, "{signal} does not end it");
        sleep(Duration::from_millis(2));
    }
}

/// Promise 10: what the machine kills leaves the old file and one unfinished one, which says whose it is.
#[test]
fn killed_at_any_time_it_leaves_the_old_file() {
    for wait in [0, 20, 100, 400] {
        let room = room();
        let before = room.listing();
        let mut child = at_work(&room);
        sleep(Duration::from_millis(wait));
        let status = hit(&mut child, "-KILL");
        assert_eq!(status.signal(), Some(9), "after {wait} ms");
        let left = unfinished(&room);
        assert!(
            matches!(left.as_slice(), [name] if name.starts_with(".vase.gcode.clayforge-") && name.ends_with(".tmp")),
            "after {wait} ms: {left:?}"
        );
        let after = room.listing();
        assert!(before.iter().all(|(name, bytes)| after[name] == *bytes), "after {wait} ms");
        // What was left does not stand in the way of the next.
        room.run(&["slice", "vase.stl", "--quiet"]).done();
        assert_eq!(unfinished(&room), left, "after {wait} ms");
    }
}

/// Promise 10: who asks it to end gets the folder as it was, and the code of an interrupt.
#[test]
fn asked_to_end_it_leaves_the_folder_as_it_was() {
    for signal in ["-INT", "-TERM", "-HUP"] {
        for wait in [0, 100] {
            let room = room();
            let before = room.listing();
            let mut child = at_work(&room);
            sleep(Duration::from_millis(wait));
            let status = hit(&mut child, signal);
            assert_eq!(status.code(), Some(130), "{signal} after {wait} ms: {status}");
            assert!(room.listing() == before, "{signal} after {wait} ms: {:?}", room.listing().keys());
        }
    }
}

/// Promise 9, on every command that writes: a disk without room is an error, and the target is as it was.
#[test]
fn a_disk_without_room_is_an_error_of_every_command_that_writes() {
    let room = room();
    room.run(&["slice", "vase.stl", "-o", "made.gcode", "--quiet"]).done();
    let before = room.listing();
    for words in [
        &["slice", "vase.stl"][..],
        &["edit", "made.gcode", "-o", "vase.gcode", "scale", "--factor", "0.9"],
        &["mesh", "vase.stl", "--repair", "-o", "vase.gcode"],
        &["emulate", "made.gcode", "--csv", "vase.gcode"],
        &["craft", "carve", "vase.stl", "-o", "vase.gcode"],
    ] {
        // Blocks of half a kilobyte or a whole one; fewer than any of the files has.
        let limited = [
            &["-c", "ulimit -f 8; exec \"$0\" \"$@\"", crate::command::program().to_str().expect("a name")],
            words,
        ];
        let mut command = room.command::<&str>(&[]);
        let path = command.get_current_dir().expect("it has one").to_owned();
        command = Command::new("sh");
        let output = command.args(limited.concat()).current_dir(path).output().expect("sh runs");
        let ran: Ran = output.into();
        assert_eq!(ran.code, Some(1), "{words:?}: {}", ran.err);
        assert!(ran.err.contains("no room") && ran.err.contains("hint: "), "{words:?}: {}", ran.err);
        assert!(room.listing() == before, "{words:?}: {:?}", room.listing().keys());
    }
}

/// Promise 8 of scripts: what standard output did not take is an error.
#[cfg(target_os = "linux")]
#[test]
fn a_full_device_behind_standard_output_is_an_error() {
    let room = room();
    for words in [
        &["slice", "vase.stl", "-o", "-"][..],
        &["craft", "carve", "vase.stl"],
        &["profile", "schema"],
        &["stages"],
    ] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
        let output =
            room.command(words).stdout(full).stderr(Stdio::piped()).output().expect("the command runs");
        let ran: Ran = output.into();
        assert_eq!(ran.code, Some(1), "{words:?}: {}", ran.err);
        assert!(ran.err.starts_with("error: "), "{words:?}: {}", ran.err);
    }
}

/// Nobody may write here, and root is nobody for once.
#[test]
fn a_folder_that_is_closed_is_an_error_and_stays_as_it_is() {
    const NOBODY: u32 = 65534;
    let room = room();
    let folder = room.path("vase.stl").parent().expect("a folder").to_owned();
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o555)).expect("it is ours");
    let before = room.listing();
    let mut command = room.command(&["slice", "vase.stl", "-o", "new.gcode"]);
    if fs::write(folder.join("probe"), "").is_ok() {
        fs::remove_file(folder.join("probe")).expect("it was just made");
        command.uid(NOBODY).gid(NOBODY);
    }
    let output = command.output();
    let after = room.listing();
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o755)).expect("it is ours");
    // Where nobody may run what root has built, there is nothing to see.
    let Ok(output) = output else { return };
    let ran: Ran = output.into();
    assert_eq!(ran.code, Some(1), "{}", ran.err);
    assert!(ran.err.contains("new.gcode") && ran.err.contains("hint: "), "{}", ran.err);
    assert!(after == before, "{:?}", after.keys());
}

/// `clayforge … | head -1`.
#[test]
fn a_reader_that_leaves_after_a_line_ends_it_without_a_word() {
    let room = room();
    room.run(&["slice", "vase.stl", "-o", "made.gcode", "--quiet"]).done();
    for words in [
        &["slice", "vase.stl", "-o", "-", "--quiet"][..],
        &["craft", "carve", "vase.stl"],
        &["check", "made.gcode", "--json"],
        &["edit", "made.gcode", "-o", "-", "speed", "--factor", "0.5"],
        &["profile", "show", "clay"],
    ] {
        let mut command = room.command(words);
        let mut child =
            command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the command runs");
        let mut out = child.stdout.take().expect("piped");
        out.read_exact(&mut [0; 1]).expect("it says something");
        drop(out);
        let ran: Ran = child.wait_with_output().expect("it ends").into();
        assert_eq!((ran.code, ran.err.trim()), (Some(0), ""), "{words:?}");
    }
}

/// Layers of a micron on a part of five metres are refused before any is made: the bound of the setting comes before the
/// part is known. Behind it stands the number of layers, see `slabs` of carve.
#[test]
fn layers_without_end_are_refused_before_any_is_made() {
    let room = Room::new();
    room.put("mast.stl", stl(&cuboid([0.0; 3], [20.0, 20.0, 5000.0])));
    let before = room.listing();
    for key in ["carve.layer_height", "carve.first_layer_height"] {
        let set = format!("{key}=0.001");
        let ran = room.run(&["slice", "mast.stl", "--set", "machine.bed=[200, 200, 6000]", "--set", &set]);
        assert_eq!(ran.code, Some(1), "{}", ran.err);
        assert!(ran.err.contains(&format!("{key} = 0.001 is below 0.05 mm")), "{}", ran.err);
        assert!(room.listing() == before);
    }
}
