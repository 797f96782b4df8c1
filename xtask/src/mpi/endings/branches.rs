//! Runs that go on with other steps.

use std::path::Path;

use super::{Fault, History, PAD, ROWS, To, Trials, alike, by_multifrontal, expect, history};

/// Ranks that go on.
const RANKS: usize = 2;
/// A step after the last one.
const LIFT: &str = r#"
[[step]]
name = "lift"
increments = 6
displacement = [{ body = "pad", nodes = "zmax", z = 0.01 }]
"#;

impl Trials<'_> {
    /// Other steps of runs on ranks, one of which was stopped and the other has completed.
    pub(super) fn branched(&self) -> Result<(), Fault> {
        let (mut run, stopped) = self.in_the_middle("pad", "left", ROWS)?;
        let ranks = To::Ranks.of(&run);
        run.disturb("kill", &[vec!["-TERM".into()], ranks].concat())?;
        expect("left", &run.ended()?, None, &["interrupted at time"])?;
        let deck = PAD.deck();
        let drag = format!("x = {}", PAD.way);
        let turned = deck.replace(&drag, "y = -0.2");
        self.goes_on("a step stated otherwise", "turned", &stopped, &turned)?;
        let lifted = deck + LIFT;
        self.goes_on("a step after that under way", "further", &stopped, &lifted)?;
        let whole = self.root.join("pad-whole");
        self.goes_on("a step after the last", "lifted", &whole, &lifted)
    }

    /// Holds ranks that go on against one process.
    fn goes_on(&self, what: &str, name: &str, old: &Path, deck: &str) -> Result<(), Fault> {
        let on = |ranks: usize| -> Result<History, Fault> {
            let name = format!("{name}-{ranks}");
            match ranks {
                0 => self.write(&name, &by_multifrontal(deck))?,
                _ => self.write(&name, deck)?,
            }
            let folder = self.root.join(&name);
            let deck = folder.with_extension("toml");
            let [old, deck] = [old, &deck].map(|path| path.to_string_lossy());
            let words = ["resume", &old, "--threads", "1", "--with", &deck, "--out"];
            let ended = self.started(ranks, &words, &folder)?.ended()?;
            expect(what, &ended, Some(0), &["all steps completed"])?;
            history(&folder)
        };
        let differences = alike(what, &on(0)?, &on(RANKS)?)?;
        println!("{what}, on {RANKS} ranks: {differences}");
        Ok(())
    }
}
