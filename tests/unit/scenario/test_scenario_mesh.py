from command_line import written

from cosim.scenario import read_scenario


def scenario(folder, mesh):
    return written(folder, f'[ice]\nmesh = "{mesh}"\n')


def test_a_mesh_is_named_from_where_the_scenario_is(tmp_path, monkeypatch):
    (tmp_path / "cases").mkdir()
    path = scenario(tmp_path / "cases", "../shapes/sample.msh")
    monkeypatch.chdir(tmp_path)
    for source in (path, "cases/case.toml"):
        read = read_scenario(source)
        assert read.ice.mesh == str(tmp_path / "shapes" / "sample.msh")
        assert read.thermal.ice.mesh == read.ice.mesh


def test_an_absolute_mesh_stays_what_it_is_and_is_written_back(tmp_path):
    first = read_scenario(scenario(tmp_path, tmp_path / "sample.msh"))
    (tmp_path / "elsewhere").mkdir()
    copy = written(tmp_path / "elsewhere", first.to_toml())
    assert read_scenario(copy).ice.mesh == str(tmp_path / "sample.msh")
