from cosim.files import OutputError as OutputError
from cosim.report.contents import Views as Views
from cosim.report.dataset import run_dataset as run_dataset
from cosim.report.dataset import trajectory_dataset as trajectory_dataset
from cosim.report.results import write_data as write_data
from cosim.report.results import write_results as write_results
from cosim.report.run_summary import summary as summary
# who wants words and style of a page needs no model of the motion
