//! Chromium without a window, driven over pipes.
//!
//! The browser reads messages from its file 3 and writes them to its file 4; a shell joins these to
//! named pipes. Source: <https://chromedevtools.github.io/devtools-protocol/>.

use std::{
    env, fs,
    fs::File,
    io::{BufRead, BufReader, Write},
    path::PathBuf,
    process::{Child, Command, Stdio},
    sync::mpsc::{self, Receiver},
    time::{Duration, Instant},
};

use serde_json::{Value, json};

use crate::fault::Fault;

/// Time allowed for an answer.
const PATIENCE: Duration = Duration::from_secs(40);

/// Program that is run unless `CHROMIUM` names another.
const PROGRAM: &str = "chromium";

/// A browser with one page.
pub struct Chromium {
    child: Child,
    folder: PathBuf,
    to: File,
    from: Receiver<Value>,
    session: String,
    next: u64,
    /// Events that have come since they were last taken.
    events: Vec<Value>,
}

impl Chromium {
    /// Starts the browser.
    ///
    /// # Errors
    /// When there is none, or it does not answer.
    pub fn start() -> Result<Self, Fault> {
        let program = env::var("CHROMIUM").unwrap_or_else(|_| PROGRAM.into());
        let folder = env::temp_dir().join(format!("striae-chromium-{}", std::process::id()));
        let failed = |cause: std::io::Error| Fault::Browser(format!("{program}: {cause}"));
        fs::create_dir_all(&folder).map_err(failed)?;
        let pipes = [folder.join("to"), folder.join("from")];
        let made = Command::new("mkfifo")
            .args(&pipes)
            .status()
            .map_err(failed)?;
        if !made.success() {
            return Err(Fault::Browser("named pipes cannot be made".into()));
        }
        let child = Command::new("sh")
            .args([
                "-c",
                "exec \"$0\" \"$@\" 3<\"$STRIAE_TO\" 4>\"$STRIAE_FROM\"",
                &program,
            ])
            .args(["--headless=new", "--no-sandbox", "--remote-debugging-pipe"])
            .args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
            .args([
                "--window-size=1400,1100",
                "--hide-scrollbars",
                "--no-first-run",
            ])
            .args([
                "--disable-background-networking",
                "--disable-component-update",
            ])
            .arg(format!(
                "--user-data-dir={}",
                folder.join("profile").display()
            ))
            .env("STRIAE_TO", &pipes[0])
            .env("STRIAE_FROM", &pipes[1])
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .map_err(failed)?;
        let to = File::create(&pipes[0]).map_err(failed)?;
        let from = received(File::open(&pipes[1]).map_err(failed)?);
        let mut browser = Self {
            child,
            folder,
            to,
            from,
            session: String::new(),
            next: 0,
            events: Vec::new(),
        };
        let page = browser.ask("Target.createTarget", &json!({ "url": "about:blank" }))?;
        let target = json!({ "targetId": page["targetId"], "flatten": true });
        let attached = browser.ask("Target.attachToTarget", &target)?;
        browser.session = attached["sessionId"]
            .as_str()
            .unwrap_or_default()
            .to_owned();
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.ask(&format!("{domain}.enable"), &json!({}))?;
        }
        Ok(browser)
    }

    /// Asks for something and waits for the answer.
    ///
    /// # Errors
    /// When the browser refuses or does not answer.
    pub fn ask(&mut self, method: &str, parameters: &Value) -> Result<Value, Fault> {
        self.next += 1;
        let mut message = json!({ "id": self.next, "method": method, "params": parameters });
        if !self.session.is_empty() {
            message["sessionId"] = json!(self.session);
        }
        let failed = |cause: String| Fault::Browser(format!("{method}: {cause}"));
        let bytes = [message.to_string().as_bytes(), b"\0"].concat();
        self.to
            .write_all(&bytes)
            .map_err(|cause| failed(cause.to_string()))?;
        let deadline = Instant::now() + PATIENCE;
        loop {
            let left = deadline.saturating_duration_since(Instant::now());
            let answer = self
                .from
                .recv_timeout(left)
                .map_err(|_| failed("no answer".into()))?;
            if answer["id"] != json!(self.next) {
                self.events.push(answer);
            } else if answer["error"].is_null() {
                return Ok(answer["result"].clone());
            } else {
                return Err(failed(answer["error"].to_string()));
            }
        }
    }

    /// The value of an expression on the page; promises are waited for.
    ///
    /// # Errors
    /// When it throws.
    pub fn value(&mut self, expression: &str) -> Result<Value, Fault> {
        let parameters = json!({
            "expression": expression, "awaitPromise": true, "returnByValue": true,
        });
        let answer = self.ask("Runtime.evaluate", &parameters)?;
        if answer["exceptionDetails"].is_null() {
            Ok(answer["result"]["value"].clone())
        } else {
            Err(Fault::Browser(format!(
                "{expression}: {}",
                answer["exceptionDetails"]
            )))
        }
    }

    /// Opens an address.
    ///
    /// # Errors
    /// When the browser does not answer.
    pub fn open(&mut self, address: &str) -> Result<(), Fault> {
        self.ask("Page.navigate", &json!({ "url": address }))?;
        Ok(())
    }

    /// Events of the page since the last call.
    pub fn events(&mut self) -> Vec<Value> {
        std::mem::take(&mut self.events)
    }
}

impl Drop for Chromium {
    fn drop(&mut self) {
        self.session.clear();
        let _ = self.ask("Browser.close", &json!({}));
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// Messages of the browser, read beside.
fn received(pipe: File) -> Receiver<Value> {
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        for message in BufReader::new(pipe).split(0) {
            let Ok(message) = message else { return };
            if let Ok(value) = serde_json::from_slice(&message)
                && sender.send(value).is_err()
            {
                return;
            }
        }
    });
    receiver
}
