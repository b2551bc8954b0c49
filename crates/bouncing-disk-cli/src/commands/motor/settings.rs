//! How a steady operation is computed.

use bouncing_disk::OperatingSettings;
use clap::Args;

/// The settings of the library, with its defaults.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Accuracy")]
pub(super) struct SettingsArgs {
    /// Standard error of the mean speed that is asked for, relative to the speed without load
    #[arg(long, allow_negative_numbers = true, value_name = "SHARE", default_value_t = OperatingSettings::default().relative_error)]
    relative_error: f64,
    /// Vertical motions that are averaged over
    #[arg(long, value_name = "N", default_value_t = OperatingSettings::default().members)]
    members: usize,
    /// Most impacts that all members together may take
    #[arg(long, value_name = "N", default_value_t = OperatingSettings::default().most_impacts)]
    most_impacts: u64,
    /// Size of the relaunch perturbation, in units of g/omega
    #[arg(long, allow_negative_numbers = true, value_name = "SIZE", default_value_t = OperatingSettings::default().relaunch_perturbation)]
    perturbation: f64,
    /// Seed of the perturbations
    #[arg(long, value_name = "SEED", default_value_t = OperatingSettings::default().seed)]
    seed: u64,
}

impl SettingsArgs {
    pub(super) fn settings(&self) -> OperatingSettings {
        OperatingSettings {
            relative_error: self.relative_error,
            members: self.members,
            most_impacts: self.most_impacts,
            relaunch_perturbation: self.perturbation,
            seed: self.seed,
        }
    }
}
