//! A report, used.

use std::{
    path::Path,
    thread::sleep,
    time::{Duration, Instant},
};

use serde_json::{Value, json};

use super::{chromium::Chromium, picture::Picture};
use crate::{fault::Fault, scenes::vtu::Grid};

/// Opens a report and uses it; says what is wrong with it. Pictures go to `pictures-*.png`.
///
/// # Errors
/// When the browser fails.
pub fn tried(
    browser: &mut Chromium,
    results: &Path,
    pictures: &Path,
) -> Result<Vec<String>, Fault> {
    let page = Trial {
        browser,
        results,
        pictures,
        faults: Vec::new(),
    };
    page.run()
}

struct Trial<'a> {
    browser: &'a mut Chromium,
    results: &'a Path,
    pictures: &'a Path,
    faults: Vec<String>,
}

impl Trial<'_> {
    fn run(mut self) -> Result<Vec<String>, Fault> {
        self.browser.events();
        let address = format!("file://{}", self.results.join("report.html").display());
        self.browser.open(&address)?;
        self.wait(0)?;
        let first = self.picture("first")?;
        self.expect(first.colored() > 0.01, "the first picture has no colours");
        let whole = self.shot(&json!({ "format": "png", "captureBeyondViewport": true }))?;
        whole.keep(&self.named("page"))?;
        let start = self.after("time", "0", "input", "start")?;
        self.expect(start.differs(&first) > 0.002, "the slider changes nothing");
        let last = "document.getElementById('time').max";
        let last = self
            .browser
            .value(last)?
            .as_str()
            .unwrap_or_default()
            .to_owned();
        let mut before = self.after("time", &last, "input", "last")?;
        for (field, array) in [
            ("body/displacement", "displacement"),
            ("body/cauchy_stress", "von_mises"),
            ("contact/gap", "gap"),
            ("contact/pressure", "pressure"),
        ] {
            let after = self.after("field", field, "change", array)?;
            self.expect(
                after.differs(&before) > 0.002,
                &format!("field {field} changes nothing"),
            );
            before = after;
            self.legend(array)?;
        }
        let arrows = self.after("arrows", "contact/traction", "change", "arrows")?;
        self.expect(arrows.differs(&before) > 0.0005, "arrows change nothing");
        let cut = self.after("cut", "y", "change", "cut")?;
        self.expect(cut.differs(&arrows) > 0.002, "the cut changes nothing");
        self.after("cut", "", "change", "whole")?;
        self.after("field", "body/cauchy_stress", "change", "stress")?;
        if self
            .browser
            .value("!!document.querySelector('#arrows [value=\"body/texture\"]')")?
            == json!(true)
        {
            self.after("arrows", "body/texture", "change", "texture")?;
        }
        self.quiet(&address);
        Ok(self.faults)
    }

    fn expect(&mut self, holds: bool, otherwise: &str) {
        if !holds {
            self.faults.push(otherwise.to_owned());
        }
    }

    fn named(&self, what: &str) -> std::path::PathBuf {
        let stem = self
            .pictures
            .file_name()
            .unwrap_or_default()
            .to_string_lossy();
        self.pictures.with_file_name(format!("{stem}-{what}.png"))
    }

    /// Waits until more than so many pictures have been drawn; returns how many there are.
    fn wait(&mut self, drawn: u64) -> Result<u64, Fault> {
        let deadline = Instant::now() + Duration::from_secs(30);
        while Instant::now() < deadline {
            let now = self.browser.value("document.body?.dataset.drawn ?? '0'")?;
            let now = now.as_str().and_then(|text| text.parse().ok()).unwrap_or(0);
            if now > drawn {
                return Ok(now);
            }
            sleep(Duration::from_millis(50));
        }
        Err(Fault::Browser("nothing was drawn in 30 s".into()))
    }

    /// Sets a control as a person does, and checks the effect.
    fn after(&mut self, id: &str, value: &str, event: &str, name: &str) -> Result<Picture, Fault> {
        let drawn = self.wait(0)?;
        let expression = format!(
            "(() => {{ const node = document.getElementById({id:?}); node.value = {value:?}; \
             node.dispatchEvent(new Event({event:?}, {{ bubbles: true }})); return node.value; }})()"
        );
        let set = self.browser.value(&expression)?;
        self.expect(set == json!(value), &format!("{id} has no `{value}`"));
        self.wait(drawn)?;
        self.picture(name)
    }

    /// The canvas with what lies on it.
    fn picture(&mut self, name: &str) -> Result<Picture, Fault> {
        self.browser.value(
            "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))",
        )?;
        let clip = "(() => { const { x, y, width, height } = \
                    document.getElementById('view').getBoundingClientRect(); \
                    return { x, y: y + scrollY, width, height, scale: 1 }; })()";
        let clip = self.browser.value(clip)?;
        let picture = self.shot(&json!({ "format": "png", "clip": clip }))?;
        picture.keep(&self.named(name))?;
        Ok(picture)
    }

    fn shot(&mut self, parameters: &Value) -> Result<Picture, Fault> {
        let shot = self.browser.ask("Page.captureScreenshot", parameters)?;
        Picture::new(shot["data"].as_str().unwrap_or_default())
    }

    /// The legend has the extremes of the array in the files of the parts shown at the
    /// last time.
    fn legend(&mut self, array: &str) -> Result<(), Fault> {
        let expression = "JSON.stringify(['min', 'max'].map((end) => \
                          Number(document.getElementById(`legend-${end}`).dataset.value)))";
        let said = self.browser.value(expression)?;
        let said: [f64; 2] = serde_json::from_str(said.as_str().unwrap_or_default())
            .map_err(|cause| Fault::Browser(cause.to_string()))?;
        let found = self.extremes(array)?;
        for (said, found) in said.into_iter().zip(found) {
            let same = (said - found).abs() <= 1e-12 * found.abs().max(said.abs());
            let text = format!("{array}: the legend says {said:e}, the files {found:e}");
            self.expect(same, &text);
        }
        Ok(())
    }

    fn extremes(&mut self, array: &str) -> Result<[f64; 2], Fault> {
        let expression = "JSON.stringify([...document.querySelectorAll('#parts label')]\
                          .filter((label) => label.querySelector('input').checked)\
                          .map((label) => label.textContent.replace('contact ', 'contact-')))";
        let shown = self.browser.value(expression)?;
        let shown: Vec<String> = serde_json::from_str(shown.as_str().unwrap_or_default())
            .map_err(|cause| Fault::Browser(cause.to_string()))?;
        let mut extremes = [f64::INFINITY, f64::NEG_INFINITY];
        for part in shown {
            let Some(path) = self.last_file(&part) else {
                return Err(Fault::Browser(format!("no file of `{part}`")));
            };
            let grid = Grid::read(&path).map_err(Fault::Browser)?;
            for value in grid.sizes(array) {
                extremes = [extremes[0].min(value), extremes[1].max(value)];
            }
        }
        Ok(extremes)
    }

    /// The last file of a part; those of rigid surfaces have a name of their own.
    fn last_file(&self, part: &str) -> Option<std::path::PathBuf> {
        let files = std::fs::read_dir(self.results.join("fields")).ok()?;
        let is_part = |name: &str| {
            let stem = name.rsplit_once('-').map_or(name, |(stem, _)| stem);
            stem == part || stem == format!("rigid-{part}")
        };
        let names = files.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let last = names.filter(|name| is_part(name)).max()?;
        Some(self.results.join("fields").join(last))
    }

    /// No error, no word on the console, and no request but for the page.
    fn quiet(&mut self, address: &str) {
        for event in self.browser.events() {
            let parameters = &event["params"];
            let wrong = match event["method"].as_str().unwrap_or_default() {
                "Runtime.exceptionThrown" => Some(parameters["exceptionDetails"].to_string()),
                "Runtime.consoleAPICalled" => {
                    let kind = parameters["type"].as_str().unwrap_or_default();
                    matches!(kind, "error" | "warning" | "assert")
                        .then(|| parameters["args"].to_string())
                }
                "Log.entryAdded" => {
                    let entry = &parameters["entry"];
                    // What the browser says of its own drawing is none of the page's doing.
                    let own = entry["source"] == json!("rendering");
                    (entry["level"] == json!("error") && !own).then(|| entry["text"].to_string())
                }
                "Network.requestWillBeSent" => {
                    let url = parameters["request"]["url"].as_str().unwrap_or_default();
                    let inside = url == address
                        || ["data:", "blob:", "about:"]
                            .iter()
                            .any(|s| url.starts_with(s));
                    (!inside).then(|| format!("a request to {url}"))
                }
                _ => None,
            };
            self.faults.extend(wrong);
        }
    }
}
