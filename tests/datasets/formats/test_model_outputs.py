"""Results of models of the body, by the names that Plug-in Gait gives them."""

import pytest
from shared_files import shared_like

from mocapbench.datasets import C3DFormat, CSVFormat
from mocapbench.datasets.formats.markers.c3d_parameters import read_parameters
from mocapbench.datasets.formats.model_outputs import model_outputs, output_kinds

OUTPUTS = {
    "ANGLES": "LHipAngles RAbsAnkleAngle LFootProgressAngles ThoraxAngles Ann:LKneeAngles-2",
    "FORCES": "LGroundReactionForce RNormalisedGRF LWaistForce RNeckForce",
    "MOMENTS": "LHipMoment RGroundReactionMoment RWristMoment",
    "POWERS": "LAnklePower Bob:RWaistPower",
    "MODELED_MARKERS": "CentreOfMass CentreOfMassFloor LeftFemurCOM LHJC RAJC PELO CSPO Ann:HEDO",
}


@pytest.mark.parametrize("kind", OUTPUTS)
def test_outputs_of_plug_in_gait_are_known_with_or_without_a_subject(kind):
    for name in OUTPUTS[kind].split():
        bare = name.rpartition(":")[2]
        assert output_kinds([name]) == {name: kind}
        assert output_kinds([f"Eve:{bare}"]) == {f"Eve:{bare}": kind}
        channels = tuple(f"{name}.{axis}" for axis in "xyz")
        assert model_outputs(["LTOE.x", *channels, "LKNE.z"]) == channels


def test_axes_of_a_bone_are_results_beside_its_origin_alone():
    axes = ["LTIA.x", "LTIP.x", "Bob:LTIL.x"]
    assert model_outputs(axes) == ()
    assert model_outputs(["LTIO.x", *axes]) == ("LTIO.x", "LTIA.x", "LTIP.x")
    assert model_outputs(["Bob:LTIO.x", *axes]) == ("Bob:LTIO.x", "Bob:LTIL.x")
    assert model_outputs(["LTIO-2.x", "LTIA.x", "LTIA-2.x"]) == ("LTIO-2.x", "LTIA-2.x")


MARKERS = (
    "LTOE LHEE LTIB C7 LPSI LKNE RSHO HEAD Ann:LFIN PELVIS SACR LWAForce LFinAngles LPower RMoment "
    "L_HipAngles HipAngles LHJCX LCentreOfMass O PEL LTIX lhipangles Foot_Marker1 LHipAngles_cgm"
)


@pytest.mark.parametrize("name", MARKERS.split())
def test_markers_are_no_results_of_a_model(name):
    assert output_kinds([name]) == {}


def test_names_tell_results_in_any_format(tmp_path):
    (tmp_path / "a.csv").write_text("time,LHJC.x,LKNE.x\n0,1,2\n1,2,3\n")
    channels = CSVFormat().read(tmp_path / "a.csv").channels
    assert CSVFormat().results(tmp_path / "a.csv", channels) == ("LHJC.x",)


@pytest.mark.parametrize("path", shared_like("wild/real/*.c3d"), ids=lambda path: path.name)
def test_every_point_that_a_file_of_vicon_names_as_a_result_is_known_by_its_name(path):
    parameters = read_parameters(path)
    for kind in ("ANGLES", "FORCES", "MOMENTS", "POWERS", "MODELED_MARKERS"):
        for name in parameters.texts(f"POINT:{kind}"):
            assert output_kinds([name]) == {name: kind}
    recording = C3DFormat().read(path)
    results = C3DFormat().results(path, recording.channels)
    assert results == model_outputs(recording.channels)
