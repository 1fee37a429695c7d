//! `plummer schema`: what case files and results look like, for editors and for programs that read them.

use super::arguments::{ResultOf, word};
use std::borrow::Cow;
use std::marker::PhantomData;

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::Value;

use super::export::ExportSummary;
use super::report::ReportResult;
use crate::app::case::{Case, in_words};
use crate::app::commands::InspectResult;
use crate::app::commands::analyze::{AnalysisResult, SurveyResult};
use crate::app::commands::bearing::BearingSummary;
use crate::app::commands::condense::{CondenseSummary, ImportedSummary};
use crate::app::commands::frf::FrfSummary;
use crate::app::commands::init::{CatalogueResult, DraftResult, MaterialsResult};
use crate::app::commands::modes::ModesSummary;
use crate::app::commands::result::CaseResult;
use crate::app::commands::run::{ExplainSummary, RunSummary};
use crate::app::studies::chart::{ChartResult, Stability};
use crate::app::studies::dataset::{DatasetSpec, Manifest};
use crate::app::studies::sweep::{ScriptsSummary, SweepSummary, TaskSummary};
use crate::app::verification::VerifyResult;

/// The JSON Schema of a result, without one that of the case file or, with `dataset`, of a data set's specification.
pub(super) fn schema(results: Option<ResultOf>, dataset: bool) -> Value {
    results.map_or_else(if dataset { DatasetSpec::schema } else { Case::schema }, ResultOf::schema)
}

/// Either of two results.
struct Either<A, B>(PhantomData<(A, B)>);

impl<A: JsonSchema, B: JsonSchema> JsonSchema for Either<A, B> {
    fn schema_name() -> Cow<'static, str> {
        "Either".into()
    }

    /// Others of this name are other types.
    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let forms = [generator.subschema_for::<A>(), generator.subschema_for::<B>()];
        json_schema!({ "anyOf": forms })
    }
}

impl ResultOf {
    fn schema(self) -> Value {
        match self {
            Self::Modes => of::<CaseResult<'_, ModesSummary<'_>>>(self),
            Self::Condense => of::<CaseResult<'_, Either<CondenseSummary<'_>, ImportedSummary<'_>>>>(self),
            Self::Frf => of::<CaseResult<'_, FrfSummary<'_>>>(self),
            Self::Bearing => of::<CaseResult<'_, BearingSummary<'_>>>(self),
            Self::Run => of::<Either<CaseResult<'_, RunSummary<'_>>, ExplainSummary<'_>>>(self),
            Self::Analyze => of::<Either<AnalysisResult<'_>, SurveyResult<'_>>>(self),
            Self::Chart => of::<ChartResult<'_>>(self),
            Self::Stability => of::<CaseResult<'_, Stability>>(self),
            Self::Sweep => {
                of::<Either<CaseResult<'_, SweepSummary<'_>>, Either<TaskSummary, ScriptsSummary<'_>>>>(self)
            }
            Self::Dataset => of::<Either<Manifest<'_>, Either<TaskSummary, ScriptsSummary<'_>>>>(self),
            Self::Verify => of::<VerifyResult<'_>>(self),
            Self::Inspect => of::<InspectResult<'_>>(self),
            Self::Init => of::<Either<DraftResult<'_>, Either<CatalogueResult, MaterialsResult>>>(self),
            Self::Export => of::<CaseResult<'_, ExportSummary<'_>>>(self),
            Self::Report => of::<ReportResult>(self),
        }
    }
}

/// Draft 07, as that of the case file.
fn of<T: JsonSchema>(result: ResultOf) -> Value {
    let settings = SchemaSettings::draft07().for_serialize();
    let schema = settings.into_generator().into_root_schema_for::<T>();
    let mut schema = schema.to_value();
    in_words(&mut schema, "null");
    schema["title"] = format!("result of plummer {}", word(result)).into();
    schema
}
