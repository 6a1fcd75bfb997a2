//! Runs of the monkey.

use session::volumes::Subject;

use super::paws::Monkey;
use crate::harness::has_adapter;

/// Seeds of the long run, unless `IMPASTO_SEEDS` names others, separated by commas.
const SEEDS: [u64; 5] = [1, 2, 3, 4, 5];

/// Number of actions of a long run.
const LONG: usize = 1000;

fn run(name: &'static str, seed: u64, actions: usize) -> Monkey {
    let mut monkey = Monkey::new(name, seed);
    for number in 1..=actions {
        monkey.act();
        if number % 250 == 0 && has_adapter() {
            monkey.window.picture();
        }
    }
    monkey
}

#[test]
fn a_monkey_breaks_nothing() {
    let monkey = run("monkey", 7, 150);
    let painting = monkey.window.studio().painting().unwrap();
    assert!(painting.revision > 20, "it changed little: revision {}", painting.revision);
}

#[test]
fn a_monkey_among_volumes_breaks_nothing() {
    let mut monkey = Monkey::new("monkey-scenes", 11);
    let context = monkey.window.harness().ctx.clone();
    monkey.window.studio_mut().open_scene(&context, Subject::Shape("village".to_owned()));
    for _ in 0..60 {
        monkey.act();
    }
    assert!(monkey.window.studio().volumes.is_some(), "the scene is still there");
}

#[test]
#[ignore = "does five times a thousand actions, which takes many minutes"]
fn a_monkey_breaks_nothing_in_a_thousand_actions() {
    Monkey::count_panics();
    let given = std::env::var("IMPASTO_SEEDS").ok();
    let seeds = given.map(|seeds| seeds.split(',').map(|seed| seed.parse().unwrap()).collect());
    for seed in seeds.unwrap_or_else(|| SEEDS.to_vec()) {
        let recorded = run("monkey-long", seed, LONG).settle_accounts();
        assert!(recorded > 0, "seed {seed}: the recording is lost");
    }
}
