//! Requests: the schema of all of them is docs/schema/requests.json, and their keys are options.

use calibrate::matching::{CorrectRequest, MatchRequest};
use calibrate::plan::PlanRequest;
use calibrate::quadrature::QuadratureRequest;
use calibrate::{FitRequest, ValidationRequest};
use maps::cube::CubeOptions;
use maps::{IdentifyRequest, MapRequest};
use pictures::{
    ArtMapCheckRequest, ArtMapRequest, MarksRequest, PictureRequest, RelightRequest, SampleRequest,
    ScriptRequest, SheetRequest, SwatchRequest,
};
use reports::ReportRequest;
use schemars::SchemaGenerator;
use schemars::generate::SchemaSettings;
use serde_json::{Value, json};
use suite::program::{impasto, repository};

use crate::request_page;

/// The schema of every request that programs pass.
fn schema() -> Value {
    let mut generator: SchemaGenerator = SchemaSettings::draft2020_12().into_generator();
    generator.subschema_for::<FitRequest>();
    generator.subschema_for::<ValidationRequest>();
    generator.subschema_for::<PlanRequest>();
    generator.subschema_for::<MatchRequest>();
    generator.subschema_for::<CorrectRequest>();
    generator.subschema_for::<QuadratureRequest>();
    generator.subschema_for::<ReportRequest>();
    generator.subschema_for::<PictureRequest>();
    generator.subschema_for::<RelightRequest>();
    generator.subschema_for::<ScriptRequest>();
    generator.subschema_for::<MarksRequest>();
    generator.subschema_for::<SampleRequest>();
    generator.subschema_for::<SwatchRequest>();
    generator.subschema_for::<ArtMapRequest>();
    generator.subschema_for::<ArtMapCheckRequest>();
    generator.subschema_for::<SheetRequest>();
    generator.subschema_for::<MapRequest>();
    generator.subschema_for::<IdentifyRequest>();
    generator.subschema_for::<CubeOptions>();
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Requests of impasto",
        "$defs": generator.take_definitions(true),
    })
}

/// Checks that the file at `path` holds `text`. Writes it if `IMPASTO_ACCEPT_SCHEMA` is 1.
fn assert_committed(path: &str, text: &str) {
    let file = repository(path);
    if std::env::var_os("IMPASTO_ACCEPT_SCHEMA").is_some_and(|value| value == "1") {
        std::fs::write(&file, text).unwrap();
    }
    let committed = std::fs::read_to_string(&file).unwrap();
    let mut lines = committed.lines().zip(text.lines()).enumerate();
    let first = lines.find(|(_, (committed, now))| committed != now);
    assert!(
        committed == text,
        "{path} differs: {first:?}\nif this is meant, run again with IMPASTO_ACCEPT_SCHEMA=1"
    );
}

#[test]
fn schema_of_requests_is_committed() {
    assert_committed("docs/schema/requests.json", &format!("{:#}\n", schema()));
}

#[test]
fn the_guide_has_a_table_of_every_request() {
    let schema = schema();
    let page = request_page::page(schema["$defs"].as_object().unwrap());
    assert_committed("docs/guide/requests.md", &page);
}

#[test]
fn a_value_that_an_option_does_not_take_is_refused_with_a_way_out() {
    let oils = repository("measurements/van-gogh-oils.csv");
    for (option, value, message, hint) in [
        ("--smoothness", "-1", "takes a word or a number not below 0, found `-1`", "auto"),
        ("--unevenness", "much", "takes a word or a number not below 0, found `much`", "auto"),
        ("--saunderson", "0.03", "takes K1,K2 or none, found `0.03`", "0.03,0.6"),
    ] {
        let run = impasto(&["fit", &oils, option, value]);
        let wanted = format!("error: {option} {message}\nhint: try {option} {hint}\n");
        assert_eq!((run.status, run.err.as_str()), (2, wanted.as_str()), "{option} {value}");
    }
}

#[test]
fn a_value_of_a_map_that_an_option_does_not_take_is_refused_before_the_scan_is_opened() {
    for (option, value, message, way_out) in [
        (
            "--group",
            "whites",
            "takes NAME=PIGMENT,PIGMENT.., found `whites`",
            "try --group \"whites=Lead White,Zinc White\"",
        ),
        (
            "--region",
            "120,40",
            "takes rows and columns, found `120,40`",
            "try --region 0..512,100..300",
        ),
        (
            "--spot",
            "middle",
            "takes a row and a column, or rows and columns, found `middle`",
            "try --spot 120,40 or --spot 120..124,40..44",
        ),
    ] {
        let run = impasto(&["map", "no-such-scan.hdr", option, value]);
        let wanted = format!("error: {option} {message}\nhint: {way_out}\n");
        assert_eq!((run.status, run.err.as_str()), (2, wanted.as_str()), "{option} {value}");
    }
}

#[test]
fn a_number_that_json_has_not_is_refused() {
    for (option, value) in [("--noise", "nan"), ("--penalty", "inf")] {
        let run = impasto(&["map", "no-such-scan.hdr", option, value]);
        let wanted = format!("{option}: invalid type: text \"{value}\", expected a number");
        assert!(run.status == 2 && run.err.contains(&wanted), "{}", run.err);
    }
}

#[test]
fn only_a_surface_can_exclude_its_specular_reflection() {
    let oils = repository("measurements/van-gogh-oils.csv");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("oils.json");
    let file = path.to_str().unwrap();
    for (surface, recorded) in [("none", "included"), ("0,0", "excluded")] {
        let options = ["--method", "qp", "--saunderson", surface, "--specular", "excluded"];
        let run = impasto(&[&["fit", &oils, "-o", file], &options[..]].concat());
        assert_eq!(run.status, 0, "{}", run.err);
        let library: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
        assert_eq!(library["saunderson"]["specular"], recorded, "--saunderson {surface}");
    }
}

#[test]
fn help_names_other_keys_by_their_options() {
    let run = impasto(&["fit", "--help"]);
    assert!(run.out.contains("without --saunderson, k1 stays 0.03"), "{}", run.out);
    assert!(run.out.contains("[possible values: included, excluded]"), "{}", run.out);
    assert!(
        run.out.contains("- refined:  Robust nonlinear refinement of `weighted`"),
        "{}",
        run.out
    );
}
