//! Members of a sweep: all combinations of the values, each with a folder.

use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
    str::FromStr,
};

use striae_deck::Setting;

/// Letters that the name of a folder may not have everywhere.
const UNFIT: &str = "/\\:*?\"<>|";
/// Bytes up to which a folder is named by all values; file systems have 255.
const LONGEST: usize = 200;

/// Most runs of a sweep; each has a process and a folder.
const MOST: usize = 10_000;

/// A number and its values.
#[derive(Clone, Debug)]
pub(super) struct Variation {
    settings: Vec<Setting>,
}

impl FromStr for Variation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((name, values)) = text.split_once('=') else {
            return Err(format!(
                "expected NAME=V1,V2,.., such as `mu=0.1,0.2`, found `{text}`"
            ));
        };
        let values = parted(values);
        let values = values.iter().map(|value| format!("{name}={value}").parse());
        let settings: Vec<Setting> = values.collect::<Result<_, String>>()?;
        Ok(Self { settings })
    }
}

/// Parts between commas that are not those of a function: `1,max(2,3)`.
fn parted(values: &str) -> Vec<&str> {
    let mut depth = 0_usize;
    let between = |letter: char| {
        match letter {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        letter == ',' && depth == 0
    };
    values.split(between).collect()
}

/// One run of a sweep.
pub(super) struct Member {
    /// The numbers that vary, with their values here.
    pub(super) varied: Vec<Setting>,
    /// Numbers that are the same in all runs.
    fixed: Vec<Setting>,
    pub(super) folder: PathBuf,
}

impl Member {
    /// All numbers that are set.
    pub(super) fn settings(&self) -> Vec<Setting> {
        [&self.varied[..], &self.fixed].concat()
    }

    /// Its values, for people.
    pub(super) fn name(&self) -> String {
        let names: Vec<String> = self.varied.iter().map(Setting::to_string).collect();
        names.join(",")
    }
}

/// All combinations, the last number changing fastest.
///
/// # Errors
/// A name that is stated twice, or too many combinations.
pub(super) fn members(
    variations: &[Variation],
    fixed: &[Setting],
    folder: &Path,
) -> Result<Vec<Member>, String> {
    let counts = variations.iter().map(|variation| variation.settings.len());
    let count = counts.fold(1, usize::saturating_mul);
    if count > MOST {
        return Err(format!(
            "the values have {count} combinations, each of which is a run; a sweep has at most {MOST}, so give fewer values, or vary one number at a time"
        ));
    }
    let mut known: BTreeSet<&str> = fixed.iter().map(Setting::name).collect();
    let mut all: Vec<Vec<Setting>> = vec![Vec::new()];
    for Variation { settings } in variations {
        let name = settings.first().map_or("", Setting::name);
        if !known.insert(name) {
            return Err(format!(
                "`{name}` is set or varied twice; give it in one `--set` or `--vary`"
            ));
        }
        for (at, setting) in settings.iter().enumerate() {
            if settings[..at].contains(setting) {
                return Err(format!("`--vary` has `{setting}` twice; give it once"));
            }
        }
        let longer = all.iter().flat_map(|begun| {
            let settings = settings.iter();
            settings.map(|setting| [&begun[..], std::slice::from_ref(setting)].concat())
        });
        all = longer.collect();
    }
    let member = |(at, varied): (usize, Vec<Setting>)| {
        let mut member = Member {
            varied,
            fixed: fixed.to_vec(),
            folder: PathBuf::new(),
        };
        let fit = |letter: char| match UNFIT.contains(letter) || letter.is_control() {
            true => '_',
            false => letter,
        };
        let name: String = member.name().chars().map(fit).collect();
        let name = match name.len() <= LONGEST {
            true => name,
            false => format!("run-{}", at + 1),
        };
        member.folder = folder.join(name);
        member
    };
    Ok(all.into_iter().enumerate().map(member).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn varied(texts: &[&str], fixed: &[&str]) -> Result<Vec<String>, String> {
        let variations: Vec<Variation> = texts.iter().map(|text| text.parse().unwrap()).collect();
        let fixed: Vec<Setting> = fixed.iter().map(|text| text.parse().unwrap()).collect();
        let members = members(&variations, &fixed, Path::new("s"))?;
        let folders = members.iter().map(|member| member.folder.display());
        Ok(folders.map(|folder| folder.to_string()).collect())
    }

    #[test]
    fn all_combinations_are_members_with_folders() {
        assert_eq!(
            varied(&["mu=0.1,max(0.2,0.3)", "pair.a/b.gap=1e-9,-2"], &["E=1"]).unwrap(),
            [
                "s/mu=0.1,pair.a_b.gap=1e-9",
                "s/mu=0.1,pair.a_b.gap=-2",
                "s/mu=0.3,pair.a_b.gap=1e-9",
                "s/mu=0.3,pair.a_b.gap=-2",
            ]
        );
        let long = "body.".to_owned() + &"b".repeat(300) + "=1,2";
        assert_eq!(varied(&[&long], &[]).unwrap(), ["s/run-1", "s/run-2"]);
    }

    #[test]
    fn what_is_stated_twice_is_refused() {
        for (texts, fixed, words) in [
            (
                &["mu=1", "mu=2"][..],
                &[][..],
                "`mu` is set or varied twice",
            ),
            (&["mu=1,2"], &["mu=3"], "`mu` is set or varied twice"),
            (&["mu=1,2,1.0"], &[], "`--vary` has `mu=1` twice"),
        ] {
            let found = varied(texts, fixed).unwrap_err();
            assert!(found.contains(words), "{found}");
        }
        let many: Vec<String> = (0..101).map(|value| value.to_string()).collect();
        let [first, second] = ["mu", "E"].map(|name| format!("{name}={}", many.join(",")));
        let found = varied(&[&first, &second], &[]).unwrap_err();
        assert!(
            found.contains("the values have 10201 combinations"),
            "{found}"
        );
        assert!("mu".parse::<Variation>().is_err());
        assert!("mu=1,,2".parse::<Variation>().is_err());
    }
}
