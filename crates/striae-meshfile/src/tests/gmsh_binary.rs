//! Binary Gmsh files, whole and broken, in both orders of bytes.

use super::{block, written};
use crate::gmsh;
use proptest::prelude::*;
use striae_mesh::CellKind;
use striae_mesh::generate::Block;

/// Order of the bytes of a number.
#[derive(Clone, Copy, Debug)]
enum Order {
    Little,
    Big,
}

/// A binary file under construction.
struct Binary {
    bytes: Vec<u8>,
    order: Order,
    size: usize,
}

impl Binary {
    fn line(&mut self, text: &str) {
        self.bytes.extend(text.as_bytes());
        self.bytes.push(b'\n');
    }

    fn bytes<const N: usize>(&mut self, little: [u8; N]) {
        let mut bytes = little;
        if let Order::Big = self.order {
            bytes.reverse();
        }
        self.bytes.extend(bytes);
    }

    fn integer(&mut self, word: &str) {
        self.bytes(word.parse::<i32>().unwrap().to_le_bytes());
    }

    fn size(&mut self, word: &str) {
        match self.size {
            4 => self.bytes(word.parse::<u32>().unwrap().to_le_bytes()),
            _ => self.bytes(word.parse::<u64>().unwrap().to_le_bytes()),
        }
    }

    fn real(&mut self, word: &str) {
        self.bytes(word.parse::<f64>().unwrap().to_le_bytes());
    }
}

/// The binary form of a text, with sizes of so many bytes.
fn binary(text: &str, order: Order, size: usize) -> Vec<u8> {
    let mut to = Binary {
        bytes: Vec::new(),
        order,
        size,
    };
    let mut lines = text.lines();
    let mut version = "";
    while let Some(section) = lines.next() {
        to.line(section);
        let end = section.replace('$', "$End");
        let rows: Vec<&str> = lines.by_ref().take_while(|line| *line != end).collect();
        match (section, version) {
            ("$MeshFormat", _) => {
                version = rows[0].split_once(' ').unwrap().0;
                to.line(&format!("{version} 1 {size}"));
                to.integer("1");
            }
            ("$Nodes", "2.2") => nodes_2(&mut to, &rows),
            ("$Elements", "2.2") => elements_2(&mut to, &rows),
            ("$Entities", _) => entities(&mut to, &rows),
            ("$Nodes", _) => nodes_4(&mut to, &rows),
            ("$Elements", _) => elements_4(&mut to, &rows),
            _ => rows.iter().for_each(|row| to.line(row)),
        }
        if !to.bytes.ends_with(b"\n") {
            to.line("");
        }
        to.line(&end);
    }
    to.bytes
}

fn words(row: &str) -> Vec<&str> {
    row.split_whitespace().collect()
}

fn nodes_2(to: &mut Binary, rows: &[&str]) {
    to.line(rows[0]);
    for row in &rows[1..] {
        let row = words(row);
        to.integer(row[0]);
        row[1..].iter().for_each(|word| to.real(word));
    }
}

fn elements_2(to: &mut Binary, rows: &[&str]) {
    to.line(rows[0]);
    for row in &rows[1..] {
        let row = words(row);
        to.integer(row[1]);
        to.integer("1");
        to.integer(row[2]);
        to.integer(row[0]);
        row[3..].iter().for_each(|word| to.integer(word));
    }
}

fn entities(to: &mut Binary, rows: &[&str]) {
    let counts = words(rows[0]);
    counts.iter().for_each(|word| to.size(word));
    let points: usize = counts[0].parse().unwrap();
    for (at, row) in rows[1..].iter().enumerate() {
        let row = words(row);
        to.integer(row[0]);
        let box_size = if at < points { 3 } else { 6 };
        let (place, groups) = row[1..].split_at(box_size);
        place.iter().for_each(|word| to.real(word));
        to.size(groups[0]);
        let count: usize = groups[0].parse().unwrap();
        let (groups, boundary) = groups[1..].split_at(count);
        groups.iter().for_each(|word| to.integer(word));
        if at >= points {
            to.size(boundary[0]);
            boundary[1..].iter().for_each(|word| to.integer(word));
        }
    }
}

fn head(to: &mut Binary, row: &str) -> usize {
    let row = words(row);
    row[..3].iter().for_each(|word| to.integer(word));
    to.size(row[3]);
    row[3].parse().unwrap()
}

fn nodes_4(to: &mut Binary, rows: &[&str]) {
    words(rows[0]).iter().for_each(|word| to.size(word));
    let mut rest = &rows[1..];
    while let Some((first, rows)) = rest.split_first() {
        let count = head(to, first);
        rows[..count].iter().for_each(|row| to.size(row));
        for row in &rows[count..2 * count] {
            words(row).iter().for_each(|word| to.real(word));
        }
        rest = &rows[2 * count..];
    }
}

fn elements_4(to: &mut Binary, rows: &[&str]) {
    words(rows[0]).iter().for_each(|word| to.size(word));
    let mut rest = &rows[1..];
    while let Some((first, rows)) = rest.split_first() {
        let count = head(to, first);
        for row in &rows[..count] {
            words(row).iter().for_each(|word| to.size(word));
        }
        rest = &rows[count..];
    }
}

#[test]
fn meshes_come_back_from_binary_files() {
    for cells in CellKind::ALL {
        let mesh = block(cells);
        for text in [written::gmsh2(&mesh), written::gmsh4(&mesh)] {
            for (order, size) in [(Order::Little, 8), (Order::Big, 8), (Order::Big, 4)] {
                let bytes = binary(&text, order, size);
                let back = gmsh::body(&bytes).unwrap_or_else(|fault| {
                    panic!("{cells} {order:?} {size} {}: {fault}", &text[..20])
                });
                assert_eq!(back.mesh, mesh, "{cells}");
            }
        }
    }
}

#[test]
fn node_vectors_come_from_binary_files() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    let mut to = Binary {
        bytes: binary(text, Order::Big, 8),
        order: Order::Big,
        size: 8,
    };
    to.line("$NodeData\n1\n\"fibres\"\n1\n0.0\n3\n0\n3\n2");
    for (node, x) in [("7", ["1", "0", "2"]), ("3", ["0", "1", "0.5"])] {
        to.integer(node);
        x.iter().for_each(|word| to.real(word));
    }
    to.line("\n$EndNodeData");
    let vectors = gmsh::node_data(&to.bytes, Some("fibres")).unwrap();
    let [first, second] = vectors.of_nodes([3, 7]).unwrap()[..] else {
        panic!("two vectors");
    };
    assert_eq!([first.z, second.z], [0.5, 2.0]);
}

#[test]
fn broken_binary_files_are_explained() {
    let mesh = Block::default().mesh().unwrap();
    let [two, four] =
        [written::gmsh2(&mesh), written::gmsh4(&mesh)].map(|text| binary(&text, Order::Little, 8));
    let after = |bytes: &[u8], section: &str, count: usize| {
        let found = bytes.windows(section.len());
        let at = found.clone().position(|word| word == section.as_bytes());
        bytes[..at.unwrap() + section.len() + count].to_vec()
    };
    let with = |bytes: &[u8], section: &str, at: usize, new: &[u8]| {
        let from = after(bytes, section, at).len();
        let mut bytes = bytes.to_vec();
        bytes[from..from + new.len()].copy_from_slice(new);
        bytes
    };
    // The number of nodes is a line of two bytes; each node has 28.
    let node = |at: usize| 2 + 28 * at;
    for (bytes, message) in [
        (
            after(&two, "2.2 1 8\n", 2),
            "line 2: expected the number 1 in four bytes, found the end of the file",
        ),
        (
            with(&two, "2.2 1 8\n", 0, &[1, 1, 0, 0]),
            "line 2: expected the number 1 in four bytes, found the bytes [1, 1, 0, 0]",
        ),
        (
            after(&two, "$Nodes\n", node(2) + 5),
            "$Nodes, record 3: expected a coordinate, found the end of the file",
        ),
        (
            with(&two, "$Nodes\n", node(3) + 4, &f64::NAN.to_le_bytes()),
            "$Nodes, record 4: expected finite coordinates, found node 37 at (NaN, 1, 0)",
        ),
        (
            with(&two, "$Nodes\n", node(1), &[255; 4]),
            "$Nodes, record 2: expected a node number, found `-1`",
        ),
        (
            with(&two, "$Elements\n", 2, &[99, 0, 0, 0]),
            "$Elements: expected an element type from 1 to 19, found element type 99; \
             mesh with Mesh.ElementOrder = 1",
        ),
        (
            with(&two, "$Elements\n", 6, &[99, 0, 0, 0]),
            "$Elements: expected 1 to 7 elements of this type, found 99",
        ),
        (
            after(&four, "$Entities\n", 40),
            "$Entities, record 1: expected a coordinate, found the end of the file",
        ),
        (
            after(&four, "$Elements\n", 32),
            "$Elements: expected the head of a block: dimension, entity, kind, count, \
             found the end of the file",
        ),
        (
            with(&four, "$EndNodes", 0, b"!"),
            "$Nodes, record 8: expected $EndNodes, found `$EndNodes!$Elements`",
        ),
    ] {
        assert_eq!(gmsh::body(&bytes).unwrap_err().to_string(), message);
    }
}

proptest! {
    #[test]
    fn damaged_binary_files_never_panic(cut in 0.0..1.0f64, at in 0.0..1.0f64, byte: u8) {
        let mesh = Block::default().mesh().unwrap();
        for text in [written::gmsh2(&mesh), written::gmsh4(&mesh)] {
            let mut bytes = binary(&text, Order::Little, 8);
            let end = bytes.len() as f64;
            let _ = gmsh::body(&bytes[..(cut * end) as usize]);
            bytes[(at * end) as usize] = byte;
            let _ = gmsh::body(&bytes);
        }
    }
}
