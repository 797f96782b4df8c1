//! Material cards of an Abaqus file.
//!
//! The keywords below `*MATERIAL`, up to one that is no option of materials, state its options.
//! Options of [`cards`](crate::Card) are read. Options of heat, and others that leave stresses as
//! they are without temperatures, are passed over and told as unused. Any other makes the material
//! one that cannot be used, and is named. Constants may stand for one temperature only.
//!
//! Longer than other files, as it lists the options that materials may have. Source: Abaqus
//! keywords reference guide.

use super::super::MeshFileFault;
use super::super::cards::{Card, Elasticity, MaterialCard, Moduli};
use super::keywords::{Keyword, Row};
use super::number;
use std::collections::BTreeSet;

/// Options of materials that are read or tell of a law that decks lack; any other keyword ends a
/// material.
const OPTIONS: [&str; 104] = [
    "ACOUSTIC MEDIUM",
    "ANISOTROPIC HYPERELASTIC",
    "ANNEAL TEMPERATURE",
    "BIAXIAL TEST DATA",
    "BRITTLE CRACKING",
    "BRITTLE FAILURE",
    "BRITTLE SHEAR",
    "CAP CREEP",
    "CAP HARDENING",
    "CAP PLASTICITY",
    "CAPACITY",
    "CAST IRON COMPRESSION HARDENING",
    "CAST IRON PLASTICITY",
    "CAST IRON TENSION HARDENING",
    "CLAY HARDENING",
    "CLAY PLASTICITY",
    "COMBINED TEST DATA",
    "COMPRESSION ONLY",
    "CONCRETE",
    "CONCRETE COMPRESSION DAMAGE",
    "CONCRETE COMPRESSION HARDENING",
    "CONCRETE DAMAGED PLASTICITY",
    "CONCRETE FAILURE",
    "CONCRETE TENSION DAMAGE",
    "CONCRETE TENSION STIFFENING",
    "CREEP",
    "CRUSHABLE FOAM",
    "CRUSHABLE FOAM HARDENING",
    "CYCLED PLASTIC",
    "CYCLIC HARDENING",
    "DAMAGE EVOLUTION",
    "DAMAGE INITIATION",
    "DAMAGE STABILIZATION",
    "DEFORMATION PLASTICITY",
    "DENSITY",
    "DRUCKER PRAGER",
    "DRUCKER PRAGER CREEP",
    "DRUCKER PRAGER HARDENING",
    "ELASTIC",
    "EOS",
    "EOS COMPACTION",
    "FABRIC",
    "FAIL STRAIN",
    "FAIL STRESS",
    "FAILURE RATIOS",
    "FLUID CONSTANTS",
    "FLUID LEAKOFF",
    "GAP FLOW",
    "GASKET CONTACT AREA",
    "GASKET ELASTICITY",
    "GASKET THICKNESS BEHAVIOR",
    "GEL",
    "HYPERELASTIC",
    "HYPERFOAM",
    "HYPOELASTIC",
    "HYSTERESIS",
    "LOADING DATA",
    "LOW DENSITY FOAM",
    "MOHR COULOMB",
    "MOHR COULOMB HARDENING",
    "MOISTURE SWELLING",
    "MULLINS EFFECT",
    "NO COMPRESSION",
    "NO TENSION",
    "NONLINEAR BH",
    "ORNL",
    "PERMANENT MAGNETIZATION",
    "PERMEABILITY",
    "PIEZOELECTRIC",
    "PLANAR TEST DATA",
    "PLASTIC",
    "PLASTICITY CORRECTION",
    "POROUS BULK MODULI",
    "POROUS ELASTIC",
    "POROUS FAILURE CRITERIA",
    "POROUS METAL PLASTICITY",
    "POTENTIAL",
    "RATE DEPENDENT",
    "REACTION RATE",
    "SHEAR FAILURE",
    "SHEAR RETENTION",
    "SHEAR TEST DATA",
    "SIMPLE SHEAR TEST DATA",
    "SORPTION",
    "SPECIFIC GAS CONSTANT",
    "SUPERELASTIC",
    "SUPERELASTIC HARDENING",
    "SUPERELASTIC HARDENING MODIFICATIONS",
    "SWELLING",
    "TENSILE FAILURE",
    "TENSION CUTOFF",
    "TENSION STIFFENING",
    "TRIAXIAL TEST DATA",
    "TRS",
    "UNIAXIAL",
    "UNIAXIAL TEST DATA",
    "UNLOADING DATA",
    "USER DEFINED FIELD",
    "USER MATERIAL",
    "VISCOELASTIC",
    "VISCOSITY",
    "VISCOUS",
    "VOID NUCLEATION",
    "VOLUMETRIC TEST DATA",
];

/// Options that change no stress as long as temperatures do not change, and damping, which is
/// told.
const WITHOUT_STRESS: [&str; 15] = [
    "CONDUCTIVITY",
    "DAMPING",
    "DEPVAR",
    "DIELECTRIC",
    "DIFFUSIVITY",
    "ELECTRICAL CONDUCTIVITY",
    "EXPANSION",
    "HEAT GENERATION",
    "INELASTIC HEAT FRACTION",
    "JOULE HEAT FRACTION",
    "LATENT HEAT",
    "MAGNETIC PERMEABILITY",
    "SOLUBILITY",
    "SPECIFIC HEAT",
    "USER OUTPUT VARIABLES",
];

/// All materials of a file; `explain` puts into words why one cannot be used.
pub(super) fn materials(
    keywords: &[Keyword<'_>],
    explain: impl Fn(MeshFileFault) -> String,
) -> Result<Vec<MaterialCard>, MeshFileFault> {
    let mut found: Vec<MaterialCard> = Vec::new();
    for (at, keyword) in keywords.iter().enumerate() {
        if keyword.name != "MATERIAL" {
            continue;
        }
        let name = keyword.required("NAME")?.to_owned();
        if found
            .iter()
            .any(|known| known.name.eq_ignore_ascii_case(&name))
        {
            return Err(keyword.fault("a name that no other material has"));
        }
        let options = keywords[at + 1..]
            .iter()
            .take_while(|other| is_option(other));
        let card = card(keyword, options).map_err(&explain);
        found.push(MaterialCard { name, card });
    }
    Ok(found)
}

/// Lines of the keywords that state materials.
pub(super) fn lines(keywords: &[Keyword<'_>]) -> BTreeSet<usize> {
    let mut lines = BTreeSet::new();
    let mut is_within = false;
    for keyword in keywords {
        is_within = keyword.name == "MATERIAL" || is_within && is_option(keyword);
        if is_within && !is_passed_over(keyword) {
            lines.insert(keyword.line);
        }
    }
    lines
}

/// Lines of the material in a line and of its options.
pub fn material_lines(keywords: &[Keyword<'_>], line: usize) -> Vec<usize> {
    let from = keywords.iter().skip_while(|keyword| keyword.line != line);
    let mut all = from.enumerate();
    let all = all
        .by_ref()
        .take_while(|(at, keyword)| *at == 0 || is_option(keyword));
    let read = all.filter(|(_, keyword)| !is_passed_over(keyword));
    read.map(|(_, keyword)| keyword.line).collect()
}

fn is_passed_over(keyword: &Keyword<'_>) -> bool {
    WITHOUT_STRESS.contains(&keyword.name.as_str())
}

fn is_option(keyword: &Keyword<'_>) -> bool {
    OPTIONS.contains(&keyword.name.as_str()) || is_passed_over(keyword)
}

fn card<'k>(
    material: &Keyword<'_>,
    options: impl Iterator<Item = &'k Keyword<'k>>,
) -> Result<Card, MeshFileFault> {
    let (mut density, mut elasticity, mut moduli) = (None, None, Moduli::LongTerm);
    let (mut hardening, mut relaxation) = (Vec::new(), Vec::new());
    let mut seen: Vec<&str> = Vec::new();
    for option in options.filter(|option| !is_passed_over(option)) {
        let name = option.name.as_str();
        if seen.contains(&name) {
            return Err(option.fault("an option that the material does not have already"));
        }
        seen.push(name);
        match name {
            "DENSITY" => density = read_density(option)?,
            "ELASTIC" | "HYPERELASTIC" if elasticity.is_some() => {
                return Err(option.fault("one of *ELASTIC and *HYPERELASTIC"));
            }
            "ELASTIC" => {
                elasticity = Some(elastic(option)?);
                moduli = read_moduli(option)?;
            }
            "HYPERELASTIC" => {
                elasticity = Some(hyperelastic(option)?);
                moduli = read_moduli(option)?;
            }
            "PLASTIC" => hardening = plastic(option)?,
            "VISCOELASTIC" => relaxation = prony(option)?,
            _ => {
                let expected = "*DENSITY, *ELASTIC, *HYPERELASTIC, *PLASTIC or *VISCOELASTIC";
                return Err(option.fault(expected));
            }
        }
    }
    let needed = || material.fault("*ELASTIC or *HYPERELASTIC below it");
    let elasticity = elasticity.ok_or_else(needed)?;
    let is_linear = matches!(elasticity, Elasticity::Linear { .. });
    if !hardening.is_empty() && (!is_linear || !relaxation.is_empty()) {
        return Err(material.fault("*PLASTIC with *ELASTIC alone"));
    }
    Ok(Card {
        density,
        elasticity,
        moduli,
        hardening,
        relaxation,
    })
}

/// The density; none where it is zero, as in models for statics.
fn read_density(option: &Keyword<'_>) -> Result<Option<f64>, MeshFileFault> {
    option.allow(&[])?;
    let [density] = constants::<1>(option)?;
    match density == 0.0 {
        true => Ok(None),
        false => positive(option, density, "a positive density").map(Some),
    }
}

fn elastic(option: &Keyword<'_>) -> Result<Elasticity, MeshFileFault> {
    option.allow(&["TYPE", "MODULI"])?;
    let kind = option.parameter("TYPE").unwrap_or("ISOTROPIC");
    if !["ISOTROPIC", "ISO"].contains(&kind.to_uppercase().as_str()) {
        return Err(option.fault("TYPE=ISOTROPIC"));
    }
    let [youngs_modulus, poissons_ratio] = constants::<2>(option)?;
    positive(option, youngs_modulus, "a positive Young's modulus")?;
    if !(poissons_ratio > -1.0 && poissons_ratio < 0.5) {
        return Err(option.rows[0].fault("a Poisson's ratio above -1 and below 0.5"));
    }
    Ok(Elasticity::Linear {
        youngs_modulus,
        poissons_ratio,
    })
}

fn hyperelastic(option: &Keyword<'_>) -> Result<Elasticity, MeshFileFault> {
    let forms = ["NEO HOOKE", "MOONEY-RIVLIN", "YEOH", "OGDEN"];
    let expected = "NEO HOOKE, MOONEY-RIVLIN, YEOH or OGDEN with constants";
    let mut named = forms
        .into_iter()
        .filter(|form| option.parameter(form).is_some());
    let (Some(form), None) = (named.next(), named.next()) else {
        return Err(option.fault(expected));
    };
    option
        .allow(&[form, "N", "MODULI"])
        .map_err(|_| option.fault(expected))?;
    Ok(match form {
        "NEO HOOKE" => {
            let [c10, d1] = constants::<2>(option)?;
            let d1 = compressibility(option, &[d1])?;
            Elasticity::NeoHooke { c10, d1 }
        }
        "MOONEY-RIVLIN" => {
            let [c10, c01, d1] = constants::<3>(option)?;
            let d1 = compressibility(option, &[d1])?;
            Elasticity::MooneyRivlin { c10, c01, d1 }
        }
        "YEOH" => {
            let [c10, c20, c30, d1, d2, d3] = constants::<6>(option)?;
            let d1 = compressibility(option, &[d1, d2, d3])?;
            Elasticity::Yeoh {
                c: [c10, c20, c30],
                d1,
            }
        }
        _ => ogden(option)?,
    })
}

/// `mu_1, alpha_1, .., mu_N, alpha_N, D_1, .., D_N`.
fn ogden(option: &Keyword<'_>) -> Result<Elasticity, MeshFileFault> {
    let count = option.parameter("N").unwrap_or("1");
    let count: Option<usize> = count.parse().ok().filter(|count| (1..=6).contains(count));
    let count = count.ok_or_else(|| option.fault("N from 1 to 6"))?;
    let all = several(option, 3 * count)?;
    let terms = all[..2 * count].chunks_exact(2);
    Ok(Elasticity::Ogden {
        terms: terms.map(|term| [term[0], term[1]]).collect(),
        d1: compressibility(option, &all[2 * count..])?,
    })
}

/// `D1`, where the terms of higher order are zero.
fn compressibility(option: &Keyword<'_>, all: &[f64]) -> Result<f64, MeshFileFault> {
    if all[1..].iter().any(|d| *d != 0.0) {
        return Err(option.rows[0].fault("D2 and those after it zero"));
    }
    let fault = || {
        let fault = option.rows[0].fault("D1 above zero");
        fault.with_remedy("give D1 = 2/K of a bulk modulus K, some 1000 times the shear modulus")
    };
    Some(all[0]).filter(|d1| *d1 > 0.0).ok_or_else(fault)
}

/// Rows of yield stress and plastic strain.
fn plastic(option: &Keyword<'_>) -> Result<Vec<[f64; 2]>, MeshFileFault> {
    option.allow(&["HARDENING"])?;
    let kind = option.parameter("HARDENING").unwrap_or("ISOTROPIC");
    if !kind.eq_ignore_ascii_case("ISOTROPIC") {
        return Err(option.fault("HARDENING=ISOTROPIC"));
    }
    let rows = option.rows.iter();
    let rows = rows.map(|row| {
        let expected = "yield stress and plastic strain at any temperature";
        let values = values(row)?;
        match values[..] {
            [stress] => Ok([stress, 0.0]),
            [stress, strain] => Ok([stress, strain]),
            _ => Err(row.fault(expected)),
        }
    });
    let rows = rows.collect::<Result<Vec<_>, _>>()?;
    match rows.is_empty() {
        true => Err(option.fault("rows of yield stress and plastic strain below it")),
        false => Ok(rows),
    }
}

/// Rows `g, k, tau`, of which `k` is zero.
fn prony(option: &Keyword<'_>) -> Result<Vec<[f64; 2]>, MeshFileFault> {
    let is_prony = option
        .parameter("TIME")
        .is_some_and(|time| time.eq_ignore_ascii_case("PRONY"));
    if !is_prony {
        return Err(option.fault("TIME=PRONY"));
    }
    option.allow(&["TIME"])?;
    let mut branches = Vec::new();
    for row in &option.rows {
        match values(row)?[..] {
            [g, 0.0, tau] if (0.0..1.0).contains(&g) && tau > 0.0 => branches.push([g, tau]),
            [_, k, _] if k != 0.0 => return Err(row.fault("k of 0, as volumes do not relax")),
            _ => return Err(row.fault("g from 0 to 1, k and a positive time")),
        }
    }
    branches.retain(|[g, _]| *g > 0.0);
    let sum: f64 = branches.iter().map(|[g, _]| g).sum();
    if branches.is_empty() || sum >= 1.0 {
        return Err(option.fault("shares g above 0 with a sum below 1"));
    }
    Ok(branches)
}

fn read_moduli(option: &Keyword<'_>) -> Result<Moduli, MeshFileFault> {
    let moduli = option.parameter("MODULI").unwrap_or("LONG TERM");
    let words: Vec<&str> = moduli.split_whitespace().collect();
    match words.join(" ").to_uppercase().as_str() {
        "LONG TERM" => Ok(Moduli::LongTerm),
        "INSTANTANEOUS" => Ok(Moduli::Instantaneous),
        _ => Err(option.fault("MODULI=LONG TERM or MODULI=INSTANTANEOUS")),
    }
}

/// So many constants; those that are missing are zero, and a temperature may follow.
fn constants<const N: usize>(option: &Keyword<'_>) -> Result<[f64; N], MeshFileFault> {
    let all = several(option, N)?;
    Ok(all.try_into().expect("so many constants"))
}

fn several(option: &Keyword<'_>, count: usize) -> Result<Vec<f64>, MeshFileFault> {
    let mut all = Vec::new();
    for row in &option.rows {
        all.extend(values(row)?);
    }
    if all.is_empty() {
        return Err(option.fault("constants below it"));
    }
    // Zeros behind the temperature state nothing; other numbers may be constants of more terms.
    let more = all.get(count + 1..).unwrap_or_default();
    if more.iter().any(|value| *value != 0.0) {
        return Err(option.rows[0].fault("constants at one temperature"));
    }
    all.resize(count, 0.0);
    Ok(all)
}

/// The numbers of a row; what is left blank before others is zero.
fn values(row: &Row<'_>) -> Result<Vec<f64>, MeshFileFault> {
    let last = row.words.iter().rposition(|word| !word.is_empty());
    let words = &row.words[..last.map_or(0, |last| last + 1)];
    let value = |word: &&str| match word.is_empty() {
        true => Some(0.0),
        false => number(word).filter(|value| value.is_finite()),
    };
    let values: Option<Vec<f64>> = words.iter().map(value).collect();
    values.ok_or_else(|| row.fault("numbers"))
}

fn positive(option: &Keyword<'_>, value: f64, expected: &str) -> Result<f64, MeshFileFault> {
    let row = &option.rows[0];
    Some(value)
        .filter(|value| *value > 0.0)
        .ok_or_else(|| row.fault(expected))
}
