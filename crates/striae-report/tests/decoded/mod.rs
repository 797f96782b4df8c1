//! Reads pages back, from the description of their format alone.

use std::io::Read;

use serde_json::Value;

/// A page.
pub struct Page {
    text: String,
    /// All but the blocks.
    pub head: Value,
}

impl Page {
    /// Reads a page.
    pub fn of(text: &str) -> Self {
        let head = between(text, "<script type=\"application/json\" id=\"results\">");
        Self {
            head: serde_json::from_str(head).unwrap(),
            text: text.to_owned(),
        }
    }

    fn block(&self, number: &Value) -> Vec<u8> {
        let text = between(
            &self.text,
            &format!("<script type=\"text/plain\" id=\"block-{number}\">"),
        );
        let mut bytes = Vec::new();
        flate2::read::ZlibDecoder::new(&plain(text)[..])
            .read_to_end(&mut bytes)
            .unwrap();
        bytes
    }

    /// Whole numbers of a block.
    pub fn indices(&self, number: &Value, stride: usize) -> Vec<i64> {
        let bytes = self.block(number);
        let count = bytes.len() / 4;
        let mut out: Vec<i64> = Vec::new();
        for at in 0..count {
            let word = (0..4)
                .map(|byte| i64::from(bytes[byte * count + at]) << (8 * byte))
                .sum();
            let before = if at < stride { 0 } else { out[at - stride] };
            out.push(before + unfolded(word));
        }
        out
    }

    /// A field of a part at a time, point by point.
    pub fn field(&self, part: &Value, name: &str, time: usize) -> Option<Vec<f64>> {
        let field = field(part, name);
        let components = field["components"].as_u64().unwrap() as usize;
        let nodes = part["nodes"].as_u64().unwrap() as usize;
        let scales = field["scales"].as_array().unwrap();
        let scale = scales[time].as_array()?;
        let bytes = self.block(&field["block"]);
        let count = bytes.len() / 2;
        let predictions = field["predictions"].as_str().unwrap().as_bytes();
        let mut codes = vec![0_i64; count];
        for (row, prediction) in predictions.iter().enumerate() {
            for node in 0..nodes {
                let at = row * nodes + node;
                let folded = i64::from(bytes[at]) + 256 * i64::from(bytes[count + at]);
                let left = if node > 0 { codes[at - 1] } else { 0 };
                let earlier = |at: usize| codes[at - components * nodes];
                let expected = match prediction {
                    b's' => left,
                    b't' => earlier(at),
                    _ if node == 0 => earlier(at),
                    _ => earlier(at) + left - earlier(at - 1),
                };
                codes[at] = (expected + unfolded(folded)).rem_euclid(65536);
            }
        }
        let known = scales[..time]
            .iter()
            .filter(|scale| !scale.is_null())
            .count();
        let [least, step] = [0, 1].map(|at| scale[at].as_f64().unwrap());
        let value = |node: usize, component: usize| {
            least + step * codes[(known * components + component) * nodes + node] as f64
        };
        let points = (0..nodes).flat_map(|node| (0..components).map(move |c| (node, c)));
        Some(
            points
                .map(|(node, component)| value(node, component))
                .collect(),
        )
    }
}

/// Description of a field in a part.
pub fn field<'a>(part: &'a Value, name: &str) -> &'a Value {
    let fields = part["fields"].as_array().unwrap();
    fields.iter().find(|field| field["name"] == name).unwrap()
}

fn between<'a>(text: &'a str, start: &str) -> &'a str {
    let after = text.split_once(start).unwrap().1;
    after.split_once("</script>").unwrap().0
}

fn unfolded(number: i64) -> i64 {
    if number % 2 == 0 {
        number / 2
    } else {
        -(number + 1) / 2
    }
}

fn plain(text: &str) -> Vec<u8> {
    let value = |letter: u8| -> u32 {
        let letters = (b'A'..=b'Z')
            .chain(b'a'..=b'z')
            .chain(b'0'..=b'9')
            .chain(*b"+/");
        letters
            .into_iter()
            .position(|known| known == letter)
            .unwrap_or(0) as u32
    };
    let padding = text
        .bytes()
        .rev()
        .take_while(|letter| *letter == b'=')
        .count();
    let mut bytes = Vec::new();
    for four in text.as_bytes().chunks(4) {
        let word = four
            .iter()
            .fold(0, |word, letter| word << 6 | value(*letter));
        bytes.extend([16, 8, 0].map(|shift| (word >> shift) as u8));
    }
    bytes.truncate(bytes.len() - padding);
    bytes
}
