//! Profiles.

use super::Target;
use clayforge::{Notes, Profile, Source, only_built_in};

pub(super) const TARGET: Target = Target {
    name: "profile",
    law: "a profile that is read is shown and read again as the same",
    run,
    dictionary: &[
        "[machine]\n",
        "[carve]\n",
        "[fill]\n",
        "[speed]\n",
        "[import]\n",
        "[clay]\n",
        "[dimension]\n",
        "[alteration]\n",
        "[[fill]]\n",
        "inherits = \"clay\"\n",
        "chain = \"seed\"\n",
        "sequence = [\"carve\", \"preface\", \"inset\", \"fill\", \"export\"]\n",
        "bed = [200, 200, 200]\n",
        "e_unit = { ram = 50 }\n",
        "e_unit = { filament = 1.75 }\n",
        "e_unit = \"mm3\"\n",
        "active = false\n",
        "walls = 2\n",
        "density = 0.2\n",
        "layer_height = 1.5\n",
        "start = \"\"\"\n",
        "\"\"\"\n",
        "true",
        "nan",
        "+inf",
        "0x10",
        "1e5",
        "{",
        "}",
        "[",
        "]",
        "=",
        ".",
        "\"",
        "'",
        "#",
        "1979-05-27T07:32:00Z",
        "\\u0000",
        "\\U0010FFFF",
        "a.b.c.d.e = ",
        "\u{feff}",
    ],
    most: 16_384,
};

fn run(bytes: &[u8]) -> String {
    let Ok(text) = String::from_utf8(bytes.to_vec()) else { return "no UTF-8".to_owned() };
    let read = |name: &str, text| Profile::read(Source { name: name.to_owned(), text }, &only_built_in);
    match read("fuzz", text) {
        Ok(profile) => {
            let shown = profile.show();
            match read("fuzz", shown.clone()) {
                Ok(again) => assert!(again == profile, "read again it is another profile:\n{shown}"),
                Err(error) => panic!("what is shown is refused: {error}\n{shown}"),
            }
            let checked = profile.check(&mut Notes::default());
            let chain = profile.chain().map(|chain| super::size(chain.len()));
            format!(
                "{:?} {:?}",
                checked.err().map(|error| error.message),
                chain.map_err(|error| error.message)
            )
        }
        Err(error) => error.to_string(),
    }
}
