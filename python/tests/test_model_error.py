"""The error of the model beside a curve, and motions of shake tables in warnings."""

import numpy as np
import pytest

import dondolo as dd


def test_motions_of_a_table_are_not_asked_about_their_time_step(tmp_path):
    """An earthquake that is as quick is asked about its time step, one by one and as a set."""
    wall, t = dd.OneSidedWall(2.0, 0.3), np.arange(0.0, 4.0, 0.005)
    quick = np.sin(2.0 * np.pi * 15.0 * t) * np.exp(-((t - 2.0) ** 2))

    def codes(**metadata):
        records = [dd.Record(quick, 0.005, f"record {i}", metadata=metadata) for i in range(3)]
        with pytest.warns(dd.errors.DondoloWarning) as caught:
            dd.multiple_stripe(wall, records, [0.2, 9.0], progress=False)
        return {one.message.code for one in caught} & {"record_pgv_pga", "records_pgv_pga"}

    assert codes() == codes(motion="earthquake") == {"record_pgv_pga", "records_pgv_pga"}
    assert codes(motion="Shake table") == set()
    np.savetxt(tmp_path / "table.txt", quick)
    (tmp_path / "catalogue.csv").write_text("file,dt_s,units,motion\ntable.txt,0.005,m/s2,shake table\n")
    record = dd.read_catalogue(tmp_path / "catalogue.csv")[0]
    assert record.metadata["motion"] == "shake table"


def test_model_error():
    """Both curves in every file, figure and number; a bias that would raise the median is refused."""
    curve = dd.fit_fragility([0.2, 0.4, 0.6, 0.8], [4, 13, 25, 38], 44, im="pga")
    both = curve.with_model_error(-0.2, 0.3)
    assert both.theta_used == pytest.approx(curve.theta * np.exp(-0.2), rel=1e-12)
    assert both.beta_used == pytest.approx((curve.beta**2 + 0.09) ** 0.5, rel=1e-12)
    # The mean of curves whose medians scatter is the widened one
    shifts = np.random.default_rng(4).normal(-0.2, 0.3, 200_000)
    x = np.array([0.2, 0.5, 0.9])
    mean = [float(np.mean(curve(one * np.exp(-shifts)))) for one in x]
    assert both.probability(x)[1] == pytest.approx(mean, abs=2e-3)
    assert both.probability(x)[0].tolist() == curve(x).tolist()
    same = curve.with_model_error(0.0, 0.0)
    assert same.probability(0.5)[0] == pytest.approx(same.probability(0.5)[1], rel=1e-12)
    fitted, widened = both.risk(dd.HazardCurve.power_law(1e-4, 2.5))
    assert widened.annual_frequency > fitted.annual_frequency
    for bias, beta, variable in ((0.1, 0.3, "bias"), (-3.0, 0.3, "bias"), (0.0, -0.1, "beta"), (0.0, 2.1, "beta")):
        with pytest.raises(dd.errors.InputError, match=f"^{variable} = "):
            curve.with_model_error(bias, beta)
    with pytest.raises(dd.errors.DondoloError, match="no curve"):
        dd.fit_fragility([0.2, 0.4], [0, 0], 44).with_model_error(0.0, 0.3)


def test_the_widened_curve_is_never_alone(tmp_path):
    both = dd.fit_fragility([0.2, 0.4, 0.6], [4, 13, 25], 44, im="pga").with_model_error(-0.1, 0.25)
    both.to_csv(tmp_path / "both.csv")
    lines = [line for line in (tmp_path / "both.csv").read_text().splitlines() if not line.startswith("#")]
    assert [line.split(",")[1] for line in lines] == ["curve", "fitted", "with model error"]
    ax = both.plot()
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert sum("fitted: " in one for one in labels) == sum("with the error of the model" in one for one in labels) == 1
    ends = {float(line.get_xdata()[-1]) for line in ax.get_lines() if len(line.get_xdata()) > 100}
    assert len(ends) == 1
    assert not isinstance(both, dd.results.Curve)
    assert not hasattr(both, "to_nrml")
    both.save(tmp_path / "both.npz")
    again = dd.load(tmp_path / "both.npz")
    assert (again.theta_used, again.beta_used) == (both.theta_used, both.beta_used)
